#include "tests/support/paths.h"

namespace kiln {

std::string sourceDir() { return KILN_SOURCE_DIR; }
std::string binaryDir() { return KILN_BINARY_DIR; }

}  // namespace kiln
