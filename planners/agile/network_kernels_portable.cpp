#include "lane_network.hpp"

namespace agile::kernels {

void apply_portable(const Layer& layer) { apply(layer); }

}  // namespace agile::kernels
