#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/profile.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test {

/// A change to the text of a shipped shader.
struct Edit {
    std::string file;        ///< in shaders/
    std::string text;        ///< what stands there, exactly `times` times
    std::string replacement; ///< what each becomes
    int times = 1;
};

/// One bug: edits of the shipped shaders, or a fault of the host (host_faults.hpp).
struct Mutant {
    std::string name;
    std::vector<Edit> edits;
    std::string fault;
    std::string pass = "collision_pass"; ///< that of the scenes which it is run in
    std::string cause;                   ///< as a report names it; empty: no one change of the twin is the same
    /// What else does just the same in some scenes, and why.
    std::map<std::string, std::string> alike;
    /// Scenes in which it does not do what `cause` names, and why: the text is not compiled there, or does more.
    std::map<std::string, std::string> differs_in;
    std::string equivalent; ///< why it is as right as the original; empty: it is to be found
    /// The order in which it sums length and normalize, instead of the driver's own; nothing: it has nothing to do with
    /// that.
    std::optional<DotOrder> sums;

    /// Whether that is what it does.
    [[nodiscard]] bool is_called(const std::string& by) const { return by == cause || alike.contains(by); }

    /// File or host, for a table.
    [[nodiscard]] std::string where() const;
};

/// Reads a catalogue: a JSON array of objects with `name`, then `file`, `text`, `replacement` and `times` (default 1),
/// or an array `edits` of such, or `fault`; `cause`, `alike` and `differs_in` (objects), `equivalent` and `sums`
/// ("(x+y)+z") as above. Causes are names of reference/collision/deviation.hpp and formula_mistakes.cpp, or two of
/// them, "a + b"; those of another `pass` than the listing's may also be changes at a site, as "part: zero". Throws
/// Error naming the value that is wrong: an unknown fault, cause or order, a name that stands twice.
std::vector<Mutant> read_catalogue(const std::filesystem::path& file, const std::string& pass = "collision_pass");

/// All of tests/mutants/: shaders.json and host.json, and a file of each other pass.
std::vector<Mutant> whole_catalogue();

/// Whether a pass makes the listing's step: in vertex and fragment stages, or with step = compute in compute stages.
bool makes_listing(std::string_view pass);

/// The catalogue on a driver of `profile`: a mutant that sums as the driver itself does, with `precise` or without, is
/// as right there.
std::vector<Mutant> on_driver(std::vector<Mutant> catalogue, const Profile& profile);

/// Writes the edited shaders into `folder`. Throws Error if a text does not stand there as often as it should: a mutant
/// that changes nothing proves nothing.
void plant(const Mutant& mutant, const TemporaryFolder& folder);

} // namespace lockstep::test
