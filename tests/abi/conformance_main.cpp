#include <iostream>

#include "conformance/conformance.hpp"

/// Exit 0 when the planner library given keeps every rule of the interface; else says which it
/// breaks.
int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  int broken = 0;
  for (const avoidbench::ConformanceResult& result :
       avoidbench::check_conformance_isolated(arguments[1])) {
    if (result.passed) continue;
    std::cout << result.name << ": " << result.finding << '\n';
    broken = 1;
  }
  return broken;
}
