#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reference/known_operations.hpp"
#include "reference/readings/site.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/text/dispatch.hpp"
#include "reference/text/invocation.hpp"
#include "reference/undefined.hpp"

namespace lockstep::text {

/// A word that an invocation wrote, and what it may legally be.
struct WrittenWord {
    WrittenPlace place;
    std::uint32_t word = 0; ///< of an integer the first; of a float one of the set; of a code 0
    std::uint32_t more = 0; ///< of an integer: how many words after the first it may be as well
    Interval set;           ///< of a float; of a code of an rgba8 image the numbers from 0 to 255 that it may be
    bool is_real = false, is_code = false;
    [[nodiscard]] bool may_be(std::uint32_t bits) const;
    /// What it may be as a field's number. Of none that is a code.
    [[nodiscard]] Interval set_in(Scalar field) const;
};

/// One of the ways an invocation may go.
struct InvocationOutcome {
    std::vector<WrittenWord> written;      ///< in the order of places
    std::vector<OpenSite> open;            ///< comparisons on the way that could have gone otherwise: FILE:LINE
    Undefined undefined = Undefined::none; ///< then nothing is known of what it writes
};

/// What a constant of a text is: the float that it was rounded to, or any real number that is rounded so, as in a port
/// of more digits.
enum class Constants : std::uint8_t { rounded, as_written };

/// A text by sets: what each invocation may legally write, every operation judged by its own `precise` and by what is
/// known of the driver.
class Outcomes {
  public:
    /// `program` outlives it.
    explicit Outcomes(const Program& program);

    /// All outcomes of an invocation that shares nothing with others but what it reads. `known`: in the stage that the
    /// text runs in. `inputs`: of another stage than compute. What `bindings` name stays as it is. Throws Error by
    /// FILE:LINE for what is not followed by sets: barriers, atomic operations whose result is used.
    [[nodiscard]] std::vector<InvocationOutcome> of(const Invocation& invocation, std::array<std::uint32_t, 3> groups,
                                                    const Bindings& bindings, PassStage stage, const Profile& profile,
                                                    const KnownOperations& known,
                                                    Constants constants = Constants::rounded,
                                                    std::span<const GivenInput> inputs = {}) const;
    /// All outcomes of each invocation of a group that shares memory, by its number in the group. What another leaves
    /// behind a barrier is any word that it may leave there. Throws Error by FILE:LINE for what is not followed by
    /// sets.
    [[nodiscard]] std::vector<std::vector<InvocationOutcome>>
    of_group(std::uint32_t group, std::array<std::uint32_t, 3> groups, const Bindings& bindings, const Profile& profile,
             const KnownOperations& known, Constants constants = Constants::rounded) const;
    [[nodiscard]] const Program& program() const { return program_; }

  private:
    const Program& program_;
    std::vector<Site> sites_;
    std::vector<const Site*> site_of_step_;
};

/// What the outcomes of a dispatch rest on.
struct JudgedDispatch {
    std::array<std::uint32_t, 3> groups{1, 1, 1};
    PassStage stage = PassStage::compute; ///< that the text runs in
    Profile profile = {};
    KnownOperations known = {};
    Constants constants = Constants::rounded;
};

/// The outcomes of invocations of a dispatch, which are followed group by group where they share memory: what was
/// followed is kept. Any number of threads may ask.
class DispatchOutcomes {
  public:
    /// `of` and `bindings` outlive it.
    DispatchOutcomes(const Outcomes& of, const Bindings& bindings, JudgedDispatch dispatch)
        : of_(of), bindings_(bindings), dispatch_(std::move(dispatch)) {}
    [[nodiscard]] const JudgedDispatch& dispatch() const { return dispatch_; }
    /// Throws Error by FILE:LINE for what is not followed by sets.
    [[nodiscard]] std::vector<InvocationOutcome> of(const Invocation& invocation,
                                                    std::span<const GivenInput> inputs = {}) const;

  private:
    const Outcomes& of_;
    const Bindings& bindings_;
    JudgedDispatch dispatch_;
    struct Group {
        std::vector<std::vector<InvocationOutcome>> outcomes; ///< of each invocation
        std::string refused;                                  ///< why there are none
    };
    [[nodiscard]] std::shared_ptr<const Group> kept(std::uint32_t number) const;
    mutable std::mutex mutex_;
    mutable std::map<std::uint32_t, std::shared_ptr<const Group>> groups_; ///< some that were asked for
    mutable std::once_flag is_looked_at_;
    mutable bool are_undecided_ = false; ///< most invocations have more ways than are followed
    mutable std::string refused_;        ///< why no group is followed
};

} // namespace lockstep::text
