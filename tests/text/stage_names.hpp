#pragma once
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crosscheck/text/glsl_module.hpp"
#include "reference/text/program.hpp"

namespace lockstep::test {

/// Texts of stages, decoded and named.
class StageNames {
  public:
    /// Throws Error for what is not interpreted.
    const text::Program& decoded(Stage stage, const std::string& text) {
        std::unique_ptr<text::Program>& known = decoded_[text];
        if (known == nullptr) {
            auto source = std::make_shared<ShaderSource>();
            source->stage = stage;
            source->text = text;
            source->files = {"shader"};
            known = std::make_unique<text::Program>(text::decoded(text::read_module(
                spirv_of(*source), [](std::uint32_t line) { return "line " + std::to_string(line); })));
        }
        return *known;
    }
    /// What the text's first comment says, with a number behind that of a second text that says it.
    std::string name_of(const std::string& text) {
        const std::size_t at = text.find("\n// "), end = text.find('\n', at + 1);
        const std::string said = at == std::string::npos ? "?" : text.substr(at + 4, end - at - 4);
        std::vector<std::string>& known = named_[said];
        const auto place = std::find(known.begin(), known.end(), text);
        const std::ptrdiff_t number = place - known.begin() + 1;
        if (place == known.end())
            known.push_back(text);
        return number == 1 ? said : said + " (" + std::to_string(number) + ")";
    }

  private:
    std::map<std::string, std::vector<std::string>> named_;
    std::map<std::string, std::unique_ptr<text::Program>> decoded_;
};

} // namespace lockstep::test
