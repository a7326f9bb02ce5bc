#include "honest_filter.hpp"

HONEST_FILTER()
