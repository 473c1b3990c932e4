#include <string>

#include "reference/dust/count_twin.hpp"
#include "reference/dust/passes.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::dust {

std::unique_ptr<ItemPass> count_pass(const ItemPass& kernel) {
    return item_pass({.name = std::string(kernel.name()) + "_count",
                      .resource = count_buffer,
                      .stage = PassStage::compute,
                      .runs = [&kernel](int frame) { return kernel.runs(frame); },
                      .continues = true,
                      .derived = true},
                     CountTwin{});
}

} // namespace lockstep::dust
