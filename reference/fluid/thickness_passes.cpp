#include "reference/fluid/by_driver.hpp"
#include "reference/fluid/passes.hpp"
#include "reference/fluid/thickness_twin.hpp"

namespace lockstep::fluid {

void add_thickness_passes(const HostPtr& host, Passes& all) {
    const bool is_fixed = host->switches().thickness_sum == ThicknessSum::fixed;
    if (is_fixed)
        all.push_back(item_pass(options_of(*host, "thickness_clear_pass", thickness_image, PassStage::compute),
                                ThicknessClearTwin{}));
    const PassStage stage = is_fixed ? PassStage::compute : PassStage::fragment;
    all.push_back(by_points(host, [stage](const HostPtr& by) {
        return item_pass(options_of(*by, "thickness_pass", thickness_image, stage), ThicknessTwin{by});
    }));
}

} // namespace lockstep::fluid
