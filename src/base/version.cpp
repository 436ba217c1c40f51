#include "scarp/version.h"

namespace scarp {

const char* version() { return SCARP_VERSION; }

}  // namespace scarp
