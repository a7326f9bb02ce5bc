#ifndef TF_TF_H
#define TF_TF_H

#include "tf/transform_datatypes.h"

#endif
