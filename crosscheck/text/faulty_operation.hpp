#pragma once
#include <optional>
#include <span>
#include <string>

#include "crosscheck/text/gpu_comparison.hpp"
#include "reference/text/program.hpp"
#include "reference/text/trace.hpp"

namespace lockstep {

/// An operation of a text of which a driver, when it runs it alone, does not make what it has to.
struct FaultyOperation {
    std::string where; ///< FILE:LINE of the text's first such operation
    std::string words; ///< of one run of it: "inversesqrt(a) of 2: expected 0.707106769, the driver made 0.75"
    std::string repro; ///< a compute stage that does nothing else
};

/// Runs each kind of operation in the traces alone, as a compute stage in the current context, on the operands that the
/// traces came by, and holds it against what GLSL and the driver's profile have it make. Gives the first of them, in
/// the order of the text's run, that the driver makes otherwise; nothing where all are right, so that alone none is at
/// fault, or where the context has no compute stage.
std::optional<FaultyOperation> faulty_operation(const MeasuredGl& gl, const text::Program& program,
                                                std::span<const text::Trace> traces);

} // namespace lockstep
