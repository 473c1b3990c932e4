#pragma once
#include <vector>

#include "reference/fluid/sites.hpp"
#include "reference/model/fluid/host.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::fluid {

/// Particles where the host says that they are in a frame. Twin of shaders/fluid/motion_pass.comp.
struct MotionTwin {
    HostPtr host;
    std::vector<float> positions = {};

    [[nodiscard]] MotionTwin at(int frame) const { return {host, host->positions(frame)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& /*in*/, std::size_t item) const {
        const float* const p = &positions[4 * item];
        const auto to = r.note(site::position, r.read(site::handed, glm::vec3(p[0], p[1], p[2])));
        ItemWords<R> words;
        for (const auto& part : {to.x, to.y, to.z})
            words.add(part);
        words.add(r.read(site::handed, p[3]));
        return words;
    }
};

} // namespace lockstep::fluid
