#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// What a driver warns of in a shader that compiles.
struct ShaderWarning {
    std::string place;   ///< "mine/collision_pass.vert:113", or a file alone
    std::string message; ///< the driver's words
    bool operator==(const ShaderWarning&) const = default;
};

/// While one lives, warnings about programs that are made meanwhile go into a list, each once.
class ShaderWarnings {
  public:
    /// `into` outlives this.
    explicit ShaderWarnings(std::vector<ShaderWarning>& into);
    ~ShaderWarnings();
    ShaderWarnings(const ShaderWarnings&) = delete;
    ShaderWarnings& operator=(const ShaderWarnings&) = delete;

  private:
    std::vector<ShaderWarning>& into_;
    friend void note_shader_warnings(const std::vector<ShaderWarning>& found);
};

/// For all ShaderWarnings there are; the probe's own shaders are left out. Throws Error with the first where
/// shader_warnings_are_errors().
void note_shader_warnings(const std::vector<ShaderWarning>& found);

/// --werror-shaders, of the whole process.
bool& shader_warnings_are_errors();

/// Whether a stage's file is the probe's, which asks for what drivers leave open, on purpose.
bool is_of_probe(std::string_view file);

/// Whether it is about a variable that is read before anything was stored there, in the words of any driver.
bool is_about_unset_variable(const ShaderWarning& warning);

} // namespace lockstep
