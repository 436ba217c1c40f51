#include "scarp_c.h"

extern "C" int32_t scarp_has_gdal(void) {
#ifdef SCARP_WITH_GDAL
  return 1;
#else
  return 0;
#endif
}
