/* The main() that makes a program of a planner. */
#include "avoidbench/process_client.h"

int main(void) { return avoidbench_serve(avoidbench_planner_v1(AVOIDBENCH_ABI_VERSION)); }
