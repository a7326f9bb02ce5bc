// The same one, which does not say so.
#define NEEDS_OF_ITS_OWN 0U
#include "globals.cpp"  // NOLINT(bugprone-suspicious-include)
