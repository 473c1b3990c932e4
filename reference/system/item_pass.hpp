#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/interval.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/system_state.hpp"
#include "reference/readings/mistake.hpp"
#include "reference/readings/recording.hpp"
#include "reference/undefined.hpp"

namespace lockstep {

/// What a pass of one frame reads.
struct PassInput {
    const SystemView& before; ///< the state that the frame, or the pass before, left
    int frame = 0;            ///< counted from 0
};

/// The stage that a pass's shader runs in: drivers treat subnormals by stage.
enum class PassStage : std::uint8_t { vertex, compute, fragment };

/// A decision that could have gone another way, and how far its operands are from the border, in the site's unit.
struct OpenSite {
    std::string_view site, unit;
    double margin = 0.0;
};

/// What an item may legally become: one of these, with all of its fields.
struct ItemOutcome {
    std::vector<Interval> values; ///< of each component, in the order of the item's fields; an integer as a double
    std::vector<OpenSite> open;   ///< the decisions on the way here that could have gone otherwise
    Undefined undefined = Undefined::none;

    /// Whether the item has these values, all of them.
    [[nodiscard]] bool contains(const View& state, std::size_t item) const {
        return contains(item_words(state, item), state.about());
    }
    /// The same of an item's words, component by component.
    [[nodiscard]] bool contains(std::span<const std::uint32_t> words, const Resource& about) const;
};

/// Values that a shader's output told of an item's step, in the order in which it came by them.
struct ToldValue {
    std::string output;
    std::vector<float> values;
    int turn = -1; ///< of a loop over texels, as the shader counts; -1: told of the whole step
};

/// A legal run's rows, and where it ends. Of several runs the one in which the fewest values are not legal.
struct FollowedStep {
    std::vector<ReadingRow> rows;
    std::vector<OpenSite> open;
    Undefined undefined = Undefined::none;
};

/// Items of a buffer, one after the other.
struct ItemRange {
    std::size_t first = 0, count = 0;
};

/// A pass that makes each item of one buffer anew, from what the frame before left: its twin in every reading
/// (reference/readings), behind one interface. Pure: any number of threads may ask at once.
class ItemPass {
  public:
    ItemPass() = default;
    virtual ~ItemPass() = default;
    ItemPass(const ItemPass&) = delete;
    ItemPass& operator=(const ItemPass&) = delete;

    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual std::uint8_t resource() const = 0; ///< the buffer whose items it makes
    [[nodiscard]] virtual PassStage stage() const = 0;

    /// Whether the pass is there in a frame; what it writes stays as it is where not.
    [[nodiscard]] virtual bool runs(int /*frame*/) const { return true; }
    /// Whether its shader ran with the pass before: one dispatch may write several buffers, with a twin for each. It
    /// reads what the passes before it left, and its own buffer as it was before the dispatch.
    [[nodiscard]] virtual bool continues() const { return false; }

    /// Whether its items follow from other buffers alone, as a count does from what it counts: a wrong one, judged
    /// once, is put right before the next pass, which otherwise would inherit it.
    [[nodiscard]] virtual bool derived() const { return false; }

    /// Whether, from this state, an item of its buffer follows from no other of that buffer: then `after` may be the
    /// state that `in` reads.
    [[nodiscard]] virtual bool in_place(const PassInput& /*in*/) const { return false; }

    /// The fields of its buffer that it leaves as they are in every item, whatever it reads. run() and run_all() do not
    /// write columns that are null.
    [[nodiscard]] virtual std::span<const std::uint8_t> keeps() const { return {}; }

    /// The items that the pass appends in an order that nothing fixes: legal is any that has each of them once.
    /// Nothing: each item has its place.
    [[nodiscard]] virtual std::optional<ItemRange> appended(const PassInput& /*in*/) const { return {}; }

    /// Whether atomics or blending add in an order that nothing fixes: two runs of it may then differ, each being one
    /// of its outcomes.
    [[nodiscard]] virtual bool unordered() const { return false; }

    /// The output by which the twin's sites know a field of the buffer.
    [[nodiscard]] virtual std::string_view output(const Resource& about, std::uint8_t field) const = 0;

    /// Items first to last, the last excluded, into `after`.
    virtual void run(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
                     const WritableView& after) const = 0;

    /// All items at once, where the twin has a faster way to its bits; false: it has none.
    virtual bool run_all(const PassInput& /*in*/, const Profile& /*profile*/, const WritableView& /*after*/) const {
        return false;
    }

    /// This pass for one input and profile alone, with what depends on the input made once; null where nothing does.
    /// The input's state outlives it, and does not change.
    [[nodiscard]] virtual std::unique_ptr<ItemPass> prepared(const PassInput& /*in*/,
                                                             const Profile& /*profile*/) const {
        return nullptr;
    }

    /// Every legal outcome. `observed`: the state to be judged; values that it tells of, named like a site's output,
    /// are gone on from where they are legal. Null: nothing was told.
    [[nodiscard]] virtual std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item,
                                                            const Profile& profile, const KnownOperations& known,
                                                            const View* observed) const = 0;

    /// What the reference comes by on its way, in order.
    [[nodiscard]] virtual std::vector<RecordedRow> record(const PassInput& in, std::size_t item,
                                                          const Profile& profile) const = 0;

    /// The same along what the GPU told: each value is judged by those told before it.
    [[nodiscard]] virtual FollowedStep follow(const PassInput& in, std::size_t item, const Profile& profile,
                                              const KnownOperations& known, std::span<const ToldValue> told) const = 0;

    /// The sites that a step comes by: where it can go wrong.
    [[nodiscard]] virtual std::vector<SeenSite> sites(const PassInput& in, std::size_t item,
                                                      const Profile& profile) const = 0;

    /// The words of the item, field by field, with mistakes made.
    [[nodiscard]] virtual std::vector<std::uint32_t>
    mistaken(const PassInput& in, std::size_t item, const Profile& profile, std::span<const Mistake> made) const = 0;
};

/// All items of the pass's buffer. The same bits for any number of threads.
void run_pass(const ItemPass& pass, const PassInput& in, const Profile& profile, const WritableView& after);

/// The same from one state into another, which comes to share the fields that the pass keeps.
void run_pass(const ItemPass& pass, const SystemState& before, int frame, const Profile& profile, SystemState& after);

} // namespace lockstep
