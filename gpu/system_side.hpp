#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/canary.hpp"
#include "gpu/captured_vertex.hpp"
#include "gpu/side_description.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep {

/// Whatever computes the frames of a system that a check holds against its twins, pass by pass: GlSystem runs them on
/// GL, and an engine of one's own is another by deriving from this.
class SystemSide {
  public:
    SystemSide() = default;
    virtual ~SystemSide() = default;
    SystemSide(const SystemSide&) = delete;
    SystemSide& operator=(const SystemSide&) = delete;

    /// The state that the next pass starts from.
    virtual void upload(const SystemView& state) = 0;

    /// Pass `pass` of frame `frame`, both counted from 0. Returns when it is done.
    virtual void step(std::size_t pass, int frame) = 0;

    /// The state after the last pass; `state` has the extents of what was uploaded.
    virtual void read(SystemState& state) const = 0;

    /// How many vertices or invocations the last pass ran over. Nothing: that is not known.
    [[nodiscard]] virtual std::optional<std::uint64_t> ran_over() const { return {}; }

    /// Whether a buffer or image is after the last pass what `state` says, to the last bit, and has no NaN. Nothing:
    /// that is known by reading it alone. Fields whose columns are null are not asked for: those that no pass
    /// reaches().
    [[nodiscard]] virtual std::optional<bool> holds(const View& /*state*/) const { return {}; }

    /// Whether the last pass left the items that it read of the buffer it makes: `before` says what they were. Nothing:
    /// nobody knows.
    [[nodiscard]] virtual std::optional<bool> left(const View& /*before*/) const { return {}; }

    /// Whether a pass can write a field, whatever its shader does: it is bound to it. True where nobody knows.
    [[nodiscard]] virtual bool reaches(std::size_t /*pass*/, FieldId /*field*/) const { return true; }

    [[nodiscard]] virtual SideDescription describe() const { return {}; }

    /// Whether a pass can be run twice from one state, to prove that it repeats itself. Only then what follows is
    /// called.
    [[nodiscard]] virtual bool repeats() const { return false; }

    /// Fills what the pass will write with a pattern that no step computes.
    virtual void lay_canary(std::size_t /*pass*/) {}

    /// The last pass once more, from the same state. A side that repeats() overrides this: here it throws Error.
    virtual void repeat_step(std::size_t pass, int frame);

    /// What the last pass told of one item on its way: outputs by name, in order; empty where it tells nothing.
    virtual std::vector<CapturedVertex> trace(std::size_t pass, int frame, std::size_t item);
};

} // namespace lockstep
