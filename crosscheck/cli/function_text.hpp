#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"
#include "lockstep/function_table.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/profile.hpp"
#include "reference/text/outcomes.hpp"

namespace lockstep {

/// A row of a table whose arguments lead a function to an operand for which GLSL defines no result, or to a variable
/// that was never set: any result is as right as another.
struct UndefinedRow {
    std::size_t row = 0;
    std::string where, rule, what; ///< FILE:LINE of the operation
};

/// A function's own text (docs/shader_text.md), to be called with the rows of tables.
class FunctionText {
  public:
    /// `profile` and `known`: of the vertex stage with `precise`, since the text says where there is none. Throws Error
    /// by FILE:LINE for what is not interpreted.
    FunctionText(const GlslFunction& function, const std::vector<function_twin::Column>& columns, Profile profile,
                 const KnownOperations& known);

    /// In ascending order.
    [[nodiscard]] std::vector<UndefinedRow> undefined_rows(const FunctionRows& rows) const;
    /// What it returns in plain bits, row after row.
    [[nodiscard]] std::vector<std::uint32_t> values(const FunctionRows& rows) const;
    /// What the result of a row may legally be, component by component. Throws Error by FILE:LINE where sets are not
    /// followed.
    [[nodiscard]] std::vector<ItemOutcome> results(const FunctionRows& rows, std::size_t row,
                                                   const TextTaken& taken) const;

  private:
    FunctionText(const GlslFunction& function, const function_twin::Called& called,
                 const std::vector<function_twin::Column>& columns, Profile profile, const KnownOperations& known);
    [[nodiscard]] text::Bindings bound(std::span<std::uint32_t> arguments, std::span<std::uint32_t> result) const;

    Profile profile_;
    KnownOperations known_;
    std::shared_ptr<const ShaderSource> source_; ///< that lines are named by
    std::unique_ptr<const text::Program> program_;
    text::Outcomes outcomes_;
    std::vector<std::vector<std::uint32_t>> uniforms_;
    function_twin::Column result_;
};

} // namespace lockstep
