#include "source_dir.h"

namespace scarp {

std::string source_dir() { return SCARP_SOURCE_DIR; }

}  // namespace scarp
