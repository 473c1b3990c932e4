#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

/// Lines typed at a terminal, with editing, history and completion (libedit). Standard input and output are one. While
/// this lives, the first Ctrl-C after a line sets `interrupted` (signals.hpp) and ends nothing.
class LineEditor {
  public:
    /// `complete`: how the last word of a line can end, whole words.
    LineEditor(std::string prompt, std::function<std::vector<std::string>(const std::string& line)> complete);
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    /// The next line; nothing at the end of the input. Ctrl-C begins a line anew.
    std::optional<std::string> line();

  private:
    struct Editor;
    std::unique_ptr<Editor> editor_;
};

} // namespace lockstep
