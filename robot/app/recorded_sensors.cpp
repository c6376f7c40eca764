#include "robot/app/recorded_sensors.h"

namespace kiln {}
