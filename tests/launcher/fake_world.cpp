// Stands in for kiln-sim in the launcher's test: opens the socket of `--listen ipc://PATH`, then
// waits for SIGTERM.
#include <cstdio>
#include <cstring>
#include <string>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

int main(int argc, char** argv) {
  std::string path;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--listen") == 0) path = argv[i + 1];
  }
  const std::string scheme = "ipc://";
  if (path.rfind(scheme, 0) != 0) return 2;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::snprintf(address.sun_path, sizeof address.sun_path, "%s", path.c_str() + scheme.size());
  const int socket_fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  if (::bind(socket_fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return 2;
  std::printf("world up, process %d\n", static_cast<int>(::getpid()));
  std::fflush(stdout);
  ::pause();
  return 0;
}
