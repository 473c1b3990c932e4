#include "reference/collision/step_pass.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/collision_twin.hpp"
#include "reference/collision/depth/depth_twin.hpp"
#include "reference/collision/layered_twin.hpp"
#include "reference/collision/octree/octree_leaves.hpp"
#include "reference/collision/octree/octree_twin.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep {
namespace {

ParticleState particle(const PassInput& in, std::size_t item) {
    using namespace collision;
    return {in.before.vec3(position, item), in.before.vec3(direction, item), in.before.real(speed, item),
            in.before.real(collide_time, item)};
}

struct ListingStep {
    static constexpr bool may_fuse = true;

    StepInputs inputs;
    const Particles* before = nullptr; ///< by the host's mistake, not the state that is handed on
    const CollisionImage* cdt = nullptr;
    std::optional<FrameParams> params = {};

    [[nodiscard]] ListingStep handed(std::span<const Mistake> made) const {
        ListingStep step{inputs};
        for (const Mistake& mistake : made) {
            if (mistake.change != Change::handed_over || inputs.mixed_up == nullptr)
                continue;
            const FrameInputs& other = *inputs.mixed_up;
            switch (static_cast<Deviation>(mistake.part)) {
            case Deviation::buffers_not_swapped:
                step.before = other.earlier;
                break;
            case Deviation::stale_cdt:
                step.cdt = other.earlier_cdt != nullptr ? other.earlier_cdt : step.cdt;
                break;
            case Deviation::current_frame_cdt:
                step.cdt = step.cdt != nullptr ? step.cdt : other.drawn_cdt;
                break;
            default:
                if (other.earlier_params != nullptr) {
                    step.params = inputs.params;
                    step.params->collision_proj_view = other.earlier_params->collision_proj_view;
                }
            }
        }
        return step;
    }

    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        return CollisionTwin(r, cdt != nullptr ? *cdt : inputs.cdt, params ? *params : inputs.params)(
            before != nullptr ? (*before)[item] : particle(in, item));
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

struct DepthStep {
    static constexpr bool may_fuse = true;

    StepInputs inputs;
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        return DepthTwin(r, inputs.cdt, inputs.params)(particle(in, item));
    }
};

ItemPassOptions options(PassStage stage, const FrameParams& params) {
    return {.name = std::string(step_name(params.switches)),
            .resource = collision::particles,
            .stage = stage,
            .arithmetic = params.switches.arithmetic,
            .outputs = {"v_Position", "v_Dir", "v_Speed", "v_CollideTime"}};
}

} // namespace

std::string_view step_name(const Switches& switches) {
    if (switches.search == Search::octree)
        return "octree_pass";
    if (switches.search == Search::depth)
        return "depth_pass";
    return has_remedies(switches) ? "layered_collision_pass" : "collision_pass";
}

std::unique_ptr<ItemPass> step_pass(const StepInputs& inputs) {
    const FrameParams& params = inputs.params;
    if (params.switches.search == Search::octree)
        return item_pass(options(PassStage::compute, params),
                         OctreeStep{inputs, std::make_shared<const OctreeLeaves>(
                                                fill_leaves(inputs.before.position, inputs.obstacles, params))});
    if (params.switches.search == Search::depth)
        return item_pass(options(PassStage::compute, params), DepthStep{inputs});
    if (has_remedies(params.switches))
        return item_pass(options(PassStage::vertex, params), LayeredStep{inputs});
    const PassStage stage = params.switches.step == Step::compute ? PassStage::compute : PassStage::vertex;
    return item_pass(options(stage, params), ListingStep{inputs});
}

SystemView step_state(const StepInputs& inputs) { return {{view(inputs.before), view(inputs.cdt)}}; }

} // namespace lockstep
