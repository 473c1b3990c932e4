#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/bindings.hpp"
#include "gpu/declaration.hpp"
#include "gpu/gl.hpp"
#include "gpu/object.hpp"

namespace lockstep {

/// A uniform or attribute of a linked program.
struct ProgramVariable {
    std::string name; ///< as the program has it: "u_Tick", "Frame.tick"
    GLint location = -1;
    GLenum type = 0;
    Declaration declared = {};
    GLint block = -1; ///< of a member of a uniform block
    GLint offset = 0, matrix_stride = 0;
    bool row_major = false;
    bool transposed = false; ///< gets a matrix with rows for columns
};

/// The uniforms, or attributes, of a program by the names that passes give values under, and which of those were given.
class ProgramInterface {
  public:
    explicit ProgramInterface(std::string_view kind) : kind_(kind) {}

    /// A variable that goes by its own name; by another name; or whose components have a name or a number each.
    void add(ProgramVariable variable);
    void add(ProgramVariable variable, const std::string& name);
    void add(ProgramVariable variable, const UniformBinding& binding, const std::string& file);

    struct Given {
        std::size_t variable = 0;
        int component = -1; ///< -1: all of it
    };
    /// What `name` goes to. Throws Error where it is of another type as a whole.
    [[nodiscard]] std::vector<Given> asked(std::string_view name, GLenum type) const;
    [[nodiscard]] const ProgramVariable& operator[](std::size_t variable) const { return variables_[variable]; }
    [[nodiscard]] std::size_t size() const { return variables_.size(); }

    /// What is wrong with each variable that nothing was given for.
    [[nodiscard]] std::vector<std::string> unknown() const;

  private:
    /// "; did you mean float u_Tick?", or nothing where no name is near.
    [[nodiscard]] std::string meant_by(std::string_view name, GLenum type) const;

    std::string_view kind_;
    std::vector<ProgramVariable> variables_;
    std::multimap<std::string, Given, std::less<>> given_;
    mutable std::map<std::string, GLenum, std::less<>> asked_for_;
};

/// The values of a program's uniforms, those in uniform blocks included, whose buffers it owns.
class UniformValues {
  public:
    /// `bindings`: may be null. Throws Error for a uniform block that they do not bind, and for values that do not fit.
    UniformValues(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings);

    /// The program is in use. `words`: the bits of a value of that type; matrices by columns.
    void set(std::string_view name, GLenum type, std::span<const std::uint32_t> words) const;
    /// Binds the buffers of blocks.
    void bind() const;
    [[nodiscard]] std::vector<std::string> unknown() const { return interface_.unknown(); }

  private:
    void add(ProgramVariable variable, const Bindings* bindings);
    /// One number for each component of each element and member of an array or a structure.
    void fill(ProgramVariable& variable, const UniformBinding& binding, const std::string& file);
    void write(std::size_t variable, std::span<const std::uint32_t> words) const;
    void set_component(const ProgramInterface::Given& given, GLenum type, std::uint32_t word) const;

    ProgramInterface interface_{"uniform"};
    void add_blocks(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings);
    void add_uniforms(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings);
    void add_modules(std::span<const ShaderSource> stages, const Bindings* bindings);
    void add_block(const std::string& name, const std::string& place, GLint bytes, GLuint point,
                   const Bindings* bindings);

    std::vector<GlBuffer> blocks_;
    std::vector<GLuint> points_; ///< where each is bound
    mutable std::map<std::size_t, std::array<std::uint32_t, 4>> by_component_;
    std::vector<std::pair<ProgramInterface::Given, double>> constants_;
};

} // namespace lockstep
