#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/collision/judge/check.hpp"
#include "gpu/collision/render_pass.hpp"
#include "tests/mutants/catalogue.hpp"
#include "tests/mutants/common_rules.hpp"

namespace lockstep::test {

inline constexpr int trial_frames = 12;

/// A scene of the set, and what the reference ends it with when it runs by itself.
class TrialScene {
  public:
    /// `preset`: instead of the scene's, if not empty.
    TrialScene(const std::string& name, const std::string& preset, const Profile& profile);

    [[nodiscard]] const std::string& name() const { return name_; }
    /// The one that searches, by the name of its shader.
    [[nodiscard]] const char* pass() const;
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const Profile& profile() const { return profile_; }
    [[nodiscard]] const FinalState& expected() const { return expected_; }
    /// What the run of the shipped shaders proved; nothing tried before that run.
    PowerSummary power;

    /// The last frame as GL renders it of `particles`, with the shaders of `folder` if that is not empty.
    [[nodiscard]] ColorImage render(const Particles& particles, const std::filesystem::path& folder);
    /// And as the reference does.
    [[nodiscard]] ColorImage render_reference(const Particles& particles) const;

  private:
    std::string name_;
    Scene scene_;
    Profile profile_;
    FrameParams last_frame_;
    FinalState expected_;
    std::unique_ptr<RenderPass> render_pass_; ///< the shipped one
};

/// The scenes of tests/mutants/scenes, small enough for hundreds of runs, or those of them that `names` lists. Needs a
/// current context, which has to outlive them.
std::vector<TrialScene> trial_scenes(const Profile& profile, std::span<const std::string_view> names = {});

/// How one run of a mutant ended.
struct Trial {
    std::string scene;
    std::string verdict; ///< as `lockstep check` has it; ERROR; PIXELS: only the rendered frame differs
    std::string error;
    int frame = -1; ///< the first that differs; -1: none
    std::uint64_t divergent = 0;
    bool explained = false;          ///< a named deviation explains everything that diverged
    std::vector<std::string> causes; ///< those that explain most, the first one first
    /// The power of the shipped shaders' run in this scene says that the mutant's mistake would have shown; not set:
    /// the mistake has no name there.
    std::optional<bool> predicted;
    std::string step;                                         ///< where the first divergent item goes wrong
    std::array<std::optional<bool>, common_rule_count> rules; ///< accepted; nothing: the run had no end to compare

    [[nodiscard]] bool killed() const { return verdict != "AGREE" && verdict != "LEGAL"; }
};

/// Runs a mutant of shaders or host. The verdict is `check`'s in resync mode; what it compares, rendered by the GPU and
/// by the reference from the GPU's particles, must have the same bits, too. The other rules compare the same GPU run's
/// end with that of the reference's own run.
Trial run_trial(const Mutant& mutant, TrialScene& scene);

/// A mutant's trials, in every scene that runs its pass; of one that changes nothing, in all.
struct Outcome {
    Mutant mutant;
    std::vector<Trial> trials;

    [[nodiscard]] const Trial* killer() const;              ///< the first that kills it, null if none does
    [[nodiscard]] bool rejected_by(std::size_t rule) const; ///< in any scene
    [[nodiscard]] bool judged_by(std::size_t rule) const;
    [[nodiscard]] bool named() const; ///< the killer's first cause is the mutant's; or shown beside what it is alike
    [[nodiscard]] bool wrongly_named() const; ///< something else is said to explain everything
};

Outcome run_mutant(const Mutant& mutant, std::vector<TrialScene>& scenes);

} // namespace lockstep::test
