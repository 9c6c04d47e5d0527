/** @file gough.h
 *  All of gough: dynamics and control of Stewart–Gough platforms.
 */
#ifndef GOUGH_GOUGH_H
#define GOUGH_GOUGH_H

#include "gough/batch.h"
#include "gough/cueing.h"
#include "gough/demands.h"
#include "gough/design.h"
#include "gough/dynamics.h"
#include "gough/fields.h"
#include "gough/fleet.h"
#include "gough/floquet.h"
#include "gough/linear.h"
#include "gough/map.h"
#include "gough/model.h"
#include "gough/names.h"
#include "gough/pose.h"
#include "gough/random.h"
#include "gough/report.h"
#include "gough/result.h"
#include "gough/simulate.h"
#include "gough/sizes.h"
#include "gough/status.h"
#include "gough/study.h"
#include "gough/sweep.h"
#include "gough/text.h"
#include "gough/tune.h"
#include "gough/units.h"
#include "gough/version.h"
#include "gough/workspace.h"

#endif
