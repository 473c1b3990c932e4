#pragma once
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reference/readings/mistake.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep {

class PassSteps;

/// A mistake with a name that people use: where in a twin, and what. Tried before those that sites allow by themselves.
struct NamedMistake {
    std::string name;    ///< "gravity_missing"
    std::string meaning; ///< one line
    std::string pass;    ///< in which it is made
    Mistake mistake;
    std::vector<std::array<float, 3>> constants = {}; ///< that are tried in its formula; empty: it has none
    /// Finds its constants in an item's words before and after; empty: `constants` are all.
    std::function<std::array<float, 3>(std::span<const float>, std::span<const float>)> fit = {};
    /// Says what is seen, and so cannot be wrong where it explains everything; other causes of it are guesses.
    bool describes = false;
    /// Made in shaders that write the rest in their own way, too, which rounds otherwise.
    bool freely_written = false;
    /// Changes what a search looks at. Two of these together may be a third one that has no name.
    bool of_window = false;

    /// Whether it need only come near what it explains.
    [[nodiscard]] bool rounds() const { return freely_written || mistake.rounds(); }
    /// Whether it leaves an item's very bits, and so may be tried together with others.
    [[nodiscard]] bool is_exact() const { return constants.empty() && !fit && !rounds(); }
};

/// A particle or image system as a check sees it: what its state is, the twins of its passes in the order in which a
/// frame runs them, and how a run starts.
struct System {
    std::string name;     ///< of the run
    const Schema& schema; ///< outlives this
    std::vector<std::unique_ptr<ItemPass>> passes;
    std::vector<NamedMistake> mistakes;
    SystemState start;
    std::string settings;                                     ///< as a report has them
    std::vector<std::shared_ptr<const PassSteps>> texts = {}; ///< of each pass, or of none
    std::shared_ptr<const Schema> keeps = {};                 ///< the schema, where nobody else keeps it
};

/// Of the shader of a pass; null: it is not known.
[[nodiscard]] inline const PassSteps* text_of(const System& system, std::size_t pass) {
    return pass < system.texts.size() ? system.texts[pass].get() : nullptr;
}

/// One pass of one frame: what it started from, and what both sides made of it. Refers to the run's own data.
struct JudgedPass {
    const ItemPass& pass;
    const Profile& profile;
    const KnownOperations& known;
    int frame = 0;
    const SystemView& before;
    const View& reference; ///< of the pass's buffer
    const View& gpu;
    /// What the pass started from in the frame before; null in frame 0.
    const SystemView* earlier = nullptr;
    std::shared_ptr<const ItemPass> prepared = nullptr; ///< for its input
    bool surely_written = false;                        ///< of what diverges nothing is as it was for want of a write
    const PassSteps* text = nullptr;                    ///< of the GPU's shader

    [[nodiscard]] PassInput input() const { return {before, frame}; }
    /// The pass on its input, and on no other.
    [[nodiscard]] const ItemPass& on_input() const { return prepared ? *prepared : pass; }
    void prepare() { prepared = pass.prepared(input(), profile); }
};

} // namespace lockstep
