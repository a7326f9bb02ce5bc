#include "honest.hpp"

// Takes it for granted that hosts have an extension.
namespace {

void* create(const ab_host* host, const ab_setup* setup) {
  if (host->get_extension(host->context, AB_DEBUG_EXTENSION) != nullptr) {
    return honest::create(host, setup);
  }
  host->set_error(host->context, "no canvas");
  return nullptr;
}

}  // namespace

BAD_PLANNER(table.create = create)
