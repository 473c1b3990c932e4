#pragma once
#include <memory>
#include <string_view>

#include "reference/collision/frame_inputs.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

/// What the particles' step of one frame reads; outlives the pass.
struct StepInputs {
    const Particles& before;
    const CollisionImage& cdt;
    const Mesh& obstacles;
    const FrameParams& params;
    const FrameInputs* mixed_up = nullptr; ///< what the host's mistakes take instead; null: nothing
};

/// The twin of the particles' step of one frame, by the scene's switches: the listing's search, the octree's, the
/// depth's, or the one with remedies.
std::unique_ptr<ItemPass> step_pass(const StepInputs& inputs);

/// Its name: "collision_pass".
std::string_view step_name(const Switches& switches);

/// The state that it starts from, as one.
SystemView step_state(const StepInputs& inputs);

} // namespace lockstep
