#pragma once
/// One function of a shader, held against a twin of it on a table of arguments (docs/functions.md):
///
///     const auto result = match_function(gl, {"shaders/bounce.glsl", "bounce"}, table,
///                                        [](auto& r, const auto& velocity, const auto& normal, const auto& kept) {
///                                            return velocity - normal * (r.dot(bounce_site, velocity, normal) * kept);
///                                        });
///     CHECK(result.passed());
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lockstep/system.hpp"

namespace lockstep {

/// A function of a shader. It is called from a vertex stage, once a row of a table.
struct GlslFunction {
    std::string file; ///< that defines it: functions alone, or a whole stage, whose main is then left out
    std::string name;
    Uniforms uniforms = {};     ///< that its file declares, or a file that it includes
    ShaderDefines defines = {}; ///< what its file is compiled with
    /// "vec3, float": the types of its arguments, where its file defines several of the name. Empty: it is the only
    /// one.
    std::string parameters = {};
};

/// How a function's results are compared; as SystemMatchOptions.
struct FunctionMatchOptions {
    Legal legal = Legal::measured;
    bool allow_undefined = false;
    double power_at_least = 0.0;
    std::string repeat = {};
};

/// A table of arguments of the function's own types: float, int, std::uint32_t, bool, or a vector of GLM's of the first
/// three.
template <class... Arguments> using FunctionTable = std::vector<std::tuple<Arguments...>>;

namespace function_twin {

/// What the table's columns are.
struct Column {
    Scalar scalar = Scalar::float32;
    int components = 1;
    bool is_bool = false; ///< an int32 that is 0 or 1
};

template <class Number> constexpr bool is_vector = requires { Number::length(); };

template <class Argument> constexpr Column column_of() {
    if constexpr (is_vector<Argument>)
        return {column_of<typename Argument::value_type>().scalar, Argument::length()};
    else if constexpr (std::is_same_v<Argument, bool>)
        return {Scalar::int32, 1, true};
    else if constexpr (std::is_same_v<Argument, std::uint32_t>)
        return {Scalar::uint32, 1};
    else if constexpr (std::is_same_v<Argument, int>)
        return {Scalar::int32, 1};
    else
        return {Scalar::float32, 1};
}

/// Whether a number is no float: no reading's, but C++'s own.
template <class Number> constexpr bool is_whole() {
    if constexpr (is_vector<Number>)
        return std::is_integral_v<typename Number::value_type>;
    else
        return std::is_integral_v<Number>;
}

/// The function as a system: an item a row, whose fields are the arguments and, last, the result.
struct Called {
    Schema schema;
    std::vector<GlPass> passes;
    std::string folder;
    Column result;
};

/// Throws Error with FILE:LINE where there is no such function, where it takes or returns something else, and for a
/// uniform that is not declared.
Called called(const GlslFunction& function, const std::vector<Column>& columns);

/// Runs the function on the rows that the system starts from. Throws Error where it reads a uniform without a value.
MatchResult match_rows(const Gl& gl, const Called& called, const System& system, const FunctionMatchOptions& options);

namespace site {
inline constexpr Site argument{"argument"}, result{"result", "result"};
} // namespace site

inline constexpr std::string_view pass_name = "function";

template <class R, class Argument> auto read(R& r, const SystemView& state, FieldId field, std::size_t item) {
    if constexpr (std::is_same_v<Argument, int>) {
        return r.uniform(site::argument, state.integer(field, item));
    } else if constexpr (is_whole<Argument>()) {
        if constexpr (is_vector<Argument>) {
            Argument all;
            for (int c = 0; c < Argument::length(); ++c)
                all[c] = static_cast<typename Argument::value_type>(state.word(field, item, c));
            return all;
        } else {
            return static_cast<Argument>(state.word(field, item));
        }
    } else if constexpr (std::is_same_v<Argument, float>) {
        return r.read(site::argument, state.real(field, item));
    } else if constexpr (std::is_same_v<Argument, glm::vec3>) {
        return r.read(site::argument, state.vec3(field, item));
    } else {
        const auto c = [&](int component) { return r.read(site::argument, state.real(field, item, component)); };
        if constexpr (std::is_same_v<Argument, glm::vec2>)
            return typename R::Vec2{c(0), c(1)};
        else
            return typename R::Vec4{c(0), c(1), c(2), c(3)};
    }
}

/// A number, a vector of the reading's, or the components of one of GLM's.
template <class Number> auto parts_of(const Number& x) {
    if constexpr (is_whole<Number>() && is_vector<Number>)
        return [&]<std::size_t... c>(std::index_sequence<c...>) { return std::tie(x[static_cast<int>(c)]...); }
    (std::make_index_sequence<static_cast<std::size_t>(Number::length())>{});
    else return std::tie(x);
}

template <class Given, class Result> struct Row {
    Given given;
    Result result;
    auto fields() const {
        return std::tuple_cat(std::apply([](const auto&... one) { return std::tuple_cat(parts_of(one)...); }, given),
                              parts_of(result));
    }
};

template <class Twin, class... Arguments> struct RowTwin {
    Twin twin;

    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        return [&]<std::size_t... i>(std::index_sequence<i...>) {
            auto given = std::tuple{read<R, Arguments>(r, in.before, {0, static_cast<std::uint8_t>(i)}, item)...};
            auto result = std::apply([&](const auto&... one) { return twin(r, one...); }, given);
            if constexpr (!is_whole<decltype(result)>())
                result = r.note(site::result, result);
            return Row<decltype(given), decltype(result)>{std::move(given), std::move(result)};
        }
        (std::index_sequence_for<Arguments...>{});
    }
};

template <class Argument> void put(SystemState& state, FieldId field, std::size_t row, const Argument& value) {
    if constexpr (is_whole<Argument>() && is_vector<Argument>)
        for (int c = 0; c < Argument::length(); ++c)
            state.set(field, row, value[c], c);
    else if constexpr (std::is_same_v<Argument, bool>)
        state.set(field, row, value ? 1 : 0);
    else
        state.set(field, row, value);
}

} // namespace function_twin

/// Runs both on every row. `twin(r, arguments...)`: the function in the words of a twin (docs/own_system.md), a generic
/// lambda; it returns a number or vector of the reading's. Throws Error where the function cannot be run so.
template <class... Arguments, class Twin>
MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionTable<Arguments...>& table,
                           Twin twin, const FunctionMatchOptions& options = {}) {
    const function_twin::Called called = function_twin::called(function, {function_twin::column_of<Arguments>()...});
    System system{.name = function.name,
                  .schema = called.schema,
                  .passes = {},
                  .mistakes = {},
                  .start = {called.schema, {{table.size()}}},
                  .settings = {}};
    system.passes.push_back(item_pass({.name = std::string(function_twin::pass_name)},
                                      function_twin::RowTwin<Twin, Arguments...>{std::move(twin)}));
    for (std::size_t row = 0; row < table.size(); ++row)
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            (function_twin::put<Arguments>(system.start, {0, static_cast<std::uint8_t>(i)}, row,
                                           std::get<i>(table[row])),
             ...);
        }
    (std::index_sequence_for<Arguments...>{});
    return function_twin::match_rows(gl, called, system, options);
}

} // namespace lockstep
