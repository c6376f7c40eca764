#include "gui/link/link.h"  // the meta-object of the seam is built here
