#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "reference/system/item_pass.hpp"

namespace lockstep {

/// What a shader's own text leaves open of what it writes (docs/shader_text.md). Any number of threads may ask at once.
class OwnText {
  public:
    OwnText() = default;
    virtual ~OwnText() = default;
    OwnText(const OwnText&) = delete;
    OwnText& operator=(const OwnText&) = delete;

    /// Every legal outcome of an item, each operation judged by its own `precise`. Empty: nothing is known of it.
    [[nodiscard]] virtual std::vector<ItemOutcome>
    outcomes(const PassInput& in, std::size_t item, const Profile& profile, const KnownOperations& known) const = 0;
    /// What the text gives where its constants are the numbers that they were written as, not the floats nearest to
    /// them: a reference may compute with more digits. A GPU has the floats.
    [[nodiscard]] virtual std::vector<ItemOutcome> outcomes_as_written(const PassInput& in, std::size_t item,
                                                                       const Profile& profile,
                                                                       const KnownOperations& known) const {
        return outcomes(in, item, profile, known);
    }
    /// This for one input, which outlives it, with what depends on that made once; null where nothing does.
    [[nodiscard]] virtual std::shared_ptr<const OwnText> prepared(const PassInput& /*in*/,
                                                                  const Profile& /*profile*/) const {
        return nullptr;
    }
};

} // namespace lockstep
