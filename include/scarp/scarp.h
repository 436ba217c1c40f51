// The whole door.
#pragma once

#include "scarp/frame.h"
#include "scarp/generate.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/lines.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/picture.h"
#include "scarp/points.h"
#include "scarp/progress.h"
#include "scarp/regions.h"
#include "scarp/result.h"
#include "scarp/simplify.h"
#include "scarp/strategy.h"
#include "scarp/version.h"
#include "scarp/water.h"
