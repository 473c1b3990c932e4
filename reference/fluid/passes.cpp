#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {

Passes twins(const HostPtr& host) {
    Passes all;
    add_scene_passes(host, all);
    add_sphere_pass(host, all);
    add_filter_passes(host, all);
    add_normal_pass(host, all);
    add_thickness_passes(host, all);
    add_shade_passes(host, all);
    return all;
}

} // namespace lockstep::fluid
