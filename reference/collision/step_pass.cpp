#include "reference/collision/step_pass.hpp"

#include <utility>
#include <vector>

#include "reference/collision/collision_twin.hpp"
#include "reference/collision/layered_twin.hpp"
#include "reference/collision/octree/octree_leaves.hpp"
#include "reference/collision/octree/octree_twin.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep {
namespace {

ParticleState particle(const PassInput& in, std::size_t item) {
    using namespace collision;
    return {in.before.vec3(position, item), in.before.vec3(direction, item), in.before.real(speed, item),
            in.before.real(collide_time, item)};
}

struct ListingStep {
    StepInputs inputs;
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        return CollisionTwin(r, inputs.cdt, inputs.params)(particle(in, item));
    }
};

struct LayeredStep {
    StepInputs inputs;
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        return LayeredTwin(r, inputs.cdt, inputs.params)(particle(in, item));
    }
};

struct OctreeStep {
    StepInputs inputs;
    std::shared_ptr<const OctreeLeaves> leaves;
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        const ParticleState before = particle(in, item);
        return OctreeTwin(r, inputs.params)(static_cast<std::int32_t>(item), before,
                                            leaf_of(before.position, *leaves, inputs.params));
    }
};

ItemPassOptions options(const char* name, PassStage stage, const FrameParams& params) {
    return {.name = name,
            .resource = collision::particles,
            .stage = stage,
            .arithmetic = params.switches.arithmetic,
            .outputs = {"v_Position", "v_Dir", "v_Speed", "v_CollideTime"}};
}

} // namespace

bool is_listing(const Switches& switches) { return switches.search == Search::cdt && !has_remedies(switches); }

std::unique_ptr<ItemPass> step_pass(const StepInputs& inputs) {
    const FrameParams& params = inputs.params;
    if (params.switches.search == Search::octree)
        return item_pass(options("octree_pass", PassStage::compute, params),
                         OctreeStep{inputs, std::make_shared<const OctreeLeaves>(
                                                fill_leaves(inputs.before.position, inputs.obstacles, params))});
    if (has_remedies(params.switches))
        return item_pass(options("layered_collision_pass", PassStage::vertex, params), LayeredStep{inputs});
    return item_pass(options("collision_pass", PassStage::vertex, params), ListingStep{inputs});
}

SystemView step_state(const StepInputs& inputs) { return {{view(inputs.before), view(inputs.cdt)}}; }

} // namespace lockstep
