#pragma once
#include <functional>
#include <map>
#include <span>
#include <string>

#include "crosscheck/files/json_reader.hpp"
#include "gpu/gl_system.hpp"
#include "reference/text/program.hpp"

namespace lockstep::check_file {

/// Values of uniforms by their names in GL, elements of arrays each by itself.
class UniformValues {
  public:
    /// Reads `value` as a uniform of this type: a number, a list of its components, matrices column by column, a list
    /// of such for an array, true or false; or { "frame": step, "from": start }, a number that grows from frame to
    /// frame, or { "frames": [value, ...] }, of which the last stays. Throws Error as JsonValue does.
    void add(const std::string& name, const text::BasicType& type, const JsonValue& value);

    /// What `name`, or an element of it, has goes by `other` as well.
    void rename(const std::string& name, const std::string& other);

    [[nodiscard]] Uniforms at(int frame) const;

  private:
    std::map<std::string, std::function<UniformValue(int frame)>> by_name_;
};

} // namespace lockstep::check_file
