#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/profile.hpp"
#include "reference/text/coverage.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/memory.hpp"

namespace lockstep::text {

/// Words of inputs or outputs by name: those of one invocation or vertex after those of the one before.
using StageWords = std::map<std::string, std::vector<std::uint32_t>, std::less<>>;

/// Invocations of a vertex, geometry or fragment stage: vertices, primitives or fragments.
struct StageRun {
    std::uint32_t invocations = 0;
    /// By GL's names, or "location 3" of what has no name: words of every invocation, or of one for all of them. Of a
    /// geometry stage's input an invocation has those of each vertex of its primitive, one vertex after the other.
    /// Built-in variables go by their names too. Without being given, gl_VertexID, gl_VertexIndex and gl_PrimitiveID
    /// are the invocation's number, gl_FrontFacing is true, and gl_InstanceID, gl_InvocationID and other numbers are 0.
    StageWords inputs = {};
    /// Each four invocations are neighbours, lower left, lower right, upper left, upper right; derivatives need it.
    bool are_quads = false;
    bool is_watched = false;                  ///< as Dispatch::is_watched; unwritten outputs are looked for as well
    std::uint32_t most_branches = 50'000'000; ///< as Dispatch::most_branches
    std::uint32_t subgroup_size = 0;          ///< as Dispatch::subgroup_size
    bool keeps_outputs = true;                ///< false: StageResult stays empty
    /// Which run of each lanes_at_once, by the first; empty: all. Those that do not are in no StageResult.
    std::function<bool(std::uint32_t first)> wants = {};
    Coverage* coverage = nullptr; ///< as Dispatch::coverage
};

/// What a stage made.
struct StageResult {
    /// By GL's names: words of every invocation, or of every vertex that a geometry stage emitted. 0 of a fragment that
    /// was discarded.
    StageWords outputs;
    std::vector<std::uint8_t> is_discarded; ///< of each fragment
    /// Of a geometry stage.
    struct Strip {
        std::uint32_t invocation = 0, first = 0, count = 0; ///< first: of all vertices
    };
    std::vector<Strip> strips; ///< by EndPrimitive, and by an invocation's end
    std::uint32_t vertices = 0;
};

/// The name by which StageRun and StageResult have an input or output.
std::string name_of(const StageVariable& variable);
/// Whether an input has to be given: the text reads it, and it has no value by itself.
bool needs_words(const StageVariable& input);

/// Those of one invocation of a run, which the run has words or a default for. Empty of a compute stage.
std::vector<GivenInput> inputs_of(const Program& program, const StageRun& run, std::uint32_t invocation);

/// Runs a stage in plain bits, with the arithmetic that was measured of a driver's vertex stage. Blocks and images that
/// are bound are read and written. Throws Error for an input that is not given or that the stage does not have. Where
/// an invocation does not end, a watched run ends with a finding and the outputs of those before; another throws
/// DoesNotEnd.
StageResult run_stage(const Program& program, const StageRun& run, const Bindings& bindings, const Profile& profile,
                      Findings& findings);

} // namespace lockstep::text
