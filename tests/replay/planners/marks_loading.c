/* No planner, but a library that exports one: writes a file as soon as it is loaded. */
#include <stdio.h>
#include <stdlib.h>

#include "avoidbench/planner.h"

__attribute__((constructor)) static void mark(void) {
  const char* path = getenv("AVOIDBENCH_TEST_MARK");
  FILE* file = path != NULL ? fopen(path, "w") : NULL;
  if (file != NULL) fclose(file);
}

AB_EXPORT const ab_planner* avoidbench_planner_v1(uint32_t host_abi_version) {
  (void)host_abi_version;
  return NULL;
}
