#include "gui/ctl/signals.h"

#include <csignal>
#include <initializer_list>

namespace kiln::ctl {
namespace {
volatile std::sig_atomic_t caught = 0;
void onSignal(int) { caught = 1; }
}  // namespace

void catchSignals() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaction(signal, &action, nullptr);
}

bool signalled() { return caught != 0; }

}  // namespace kiln::ctl
