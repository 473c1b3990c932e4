#include "crosscheck/command/line_editor.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <histedit.h>
#include <poll.h>
#include <unistd.h>

#include "crosscheck/files/signals.hpp"

namespace lockstep {

struct LineEditor::Editor {
    std::string prompt;
    std::function<std::vector<std::string>(const std::string&)> complete;
    InterruptHandler interrupts;
    EditLine* edit = nullptr;
    History* history = nullptr;
};

namespace {

constexpr int lines_kept = 1000;

template <class Editor> Editor& owner_of(EditLine* edit) {
    void* owner = nullptr;
    el_get(edit, EL_CLIENTDATA, &owner);
    return *static_cast<Editor*>(owner);
}

/// Whether standard input has something, or its end; an interrupt ends the wait. It is let in by the wait alone: one
/// that came between a look at `interrupted` and the wait would be slept through.
bool wait_for_input() {
    sigset_t interrupt, before;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    pthread_sigmask(SIG_BLOCK, &interrupt, &before);
    pollfd input{STDIN_FILENO, POLLIN, 0};
    int ready = -1;
    do
        ready = interrupted ? -1 : ppoll(&input, 1, nullptr, &before);
    while (ready < 0 && errno == EINTR && !interrupted);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return ready > 0;
}

/// One byte as a character. Commands are ASCII.
int read_character(EditLine*, wchar_t* character) {
    if (!wait_for_input())
        return -1;
    unsigned char byte = 0;
    const ssize_t count = read(STDIN_FILENO, &byte, 1);
    *character = byte;
    return static_cast<int>(count);
}

/// What all begin with.
std::string common_beginning(const std::vector<std::string>& words) {
    std::string common = words.front();
    for (const std::string& word : words)
        common.resize(static_cast<std::size_t>(
            std::mismatch(common.begin(), common.end(), word.begin(), word.end()).first - common.begin()));
    return common;
}

} // namespace

LineEditor::LineEditor(std::string prompt, std::function<std::vector<std::string>(const std::string&)> complete)
    : editor_(std::make_unique<Editor>()) {
    Editor& own = *editor_;
    own.prompt = std::move(prompt);
    own.complete = std::move(complete);
    own.edit = el_init_fd("lockstep", stdin, stdout, stderr, STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO);
    own.history = history_init();
    HistEvent event;
    history(own.history, &event, H_SETSIZE, lines_kept);
    history(own.history, &event, H_SETUNIQUE, 1);
    el_set(own.edit, EL_CLIENTDATA, &own);
    el_set(own.edit, EL_EDITOR, "emacs");
    el_set(own.edit, EL_SIGNAL, 0);
    el_set(own.edit, EL_HIST, ::history, own.history);
    el_set(own.edit, EL_GETCFN, read_character);
    el_set(
        own.edit, EL_PROMPT, +[](EditLine* edit) -> char* { return owner_of<Editor>(edit).prompt.data(); });
    el_set(
        own.edit, EL_ADDFN, "complete", "complete the word", +[](EditLine* edit, int) -> unsigned char {
            Editor& editor = owner_of<Editor>(edit);
            const LineInfo* const info = el_line(edit);
            const std::string line(info->buffer, info->cursor);
            const std::vector<std::string> words = editor.complete(line);
            if (words.empty())
                return CC_ERROR;
            const std::size_t typed = line.size() - (line.find_last_of(" \t") + 1);
            const std::string common = common_beginning(words);
            const std::string rest = common.substr(std::min(typed, common.size())) + (words.size() == 1 ? " " : "");
            if (!rest.empty())
                return el_insertstr(edit, rest.c_str()) == 0 ? CC_REFRESH : CC_ERROR;
            fmt::print("\n{}\n", fmt::join(words, "  "));
            return CC_REDISPLAY;
        });
    el_set(own.edit, EL_BIND, "^I", "complete", nullptr);
}

LineEditor::~LineEditor() {
    history_end(editor_->history);
    el_end(editor_->edit);
}

std::optional<std::string> LineEditor::line() {
    for (;;) {
        editor_->interrupts.again();
        // What is typed from the prompt on is keys, not a line of the terminal's.
        el_set(editor_->edit, EL_PREP_TERM, 1);
        int length = 0;
        const char* const typed = el_gets(editor_->edit, &length);
        el_set(editor_->edit, EL_PREP_TERM, 0);
        if (typed == nullptr && interrupted) {
            fmt::print("\n");
            continue;
        }
        if (typed == nullptr || length <= 0) {
            fmt::print("\n");
            return {};
        }
        std::string line(typed, static_cast<std::size_t>(length));
        while (!line.empty() && (line.back() == '\n' || line.back() == '\r'))
            line.pop_back();
        if (!line.empty()) {
            HistEvent event;
            history(editor_->history, &event, H_ENTER, line.c_str());
        }
        return line;
    }
}

} // namespace lockstep
