#include "gpu/taken_branches.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "gpu/shader_words.hpp"

namespace lockstep {
namespace {

using Tokens = std::vector<std::string>;
using Number = std::optional<std::int64_t>; ///< nothing: not known
/// Without a text: it has parameters, or one that is not known.
struct Macro {
    std::optional<Tokens> text = {};
    bool is_sure = true; ///< to be defined
};
using Macros = std::map<std::string, Macro, std::less<>>;

constexpr int deepest = 100; // brackets and macros inside each other

/// Words and operators of a line.
Tokens tokens_of(std::string_view line) {
    static constexpr std::array<std::string_view, 8> pairs{"&&", "||", "==", "!=", "<=", ">=", "<<", ">>"};
    Tokens all;
    std::string_view last;
    for (ShaderWords words(line); words.next();) {
        const std::string_view token = words.token();
        const bool touches = !last.empty() && last.data() + last.size() == token.data();
        const std::string both = touches ? all.back() + std::string(token) : "";
        if (touches && std::ranges::find(pairs, both) != pairs.end()) {
            all.back() = both;
            last = {};
        } else {
            all.emplace_back(token);
            last = token;
        }
    }
    return all;
}

bool is_word(const std::string& token) {
    const char c = token.front();
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
/// GL's own (GL_core_profile), and those of some builds of a pass (LOCKSTEP_TRACE). GL_ES is not: shaders are GLSL's.
bool may_be_given(std::string_view name) {
    return (name.starts_with("GL_") && name != "GL_ES") || name.starts_with("__") || name.starts_with("LOCKSTEP_");
}

/// Puts the texts of macros in their places, but for operands of `defined`; false where one is not known, or where they
/// lead to more than anybody writes.
bool expand(const Tokens& tokens, const Macros& macros, Tokens& to, int depth = 0) {
    constexpr std::size_t most = 10'000;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto macro = macros.find(tokens[i]);
        const bool is_operand =
            (i > 0 && tokens[i - 1] == "defined") || (i > 1 && tokens[i - 1] == "(" && tokens[i - 2] == "defined");
        if (macro == macros.end() || is_operand)
            to.push_back(tokens[i]);
        else if (!macro->second.text || depth == deepest || !expand(*macro->second.text, macros, to, depth + 1))
            return false;
        if (to.size() > most)
            return false;
    }
    return true;
}

/// The value of what a condition says (GLSL 4.60, 3.3), its macros expanded.
class Condition {
  public:
    Condition(const Tokens& tokens, const Macros& macros) : tokens_(tokens), macros_(macros) {}

    Number value() {
        const Number found = chain(0);
        return at_ == tokens_.size() && !is_lost_ ? found : Number();
    }

  private:
    struct Operator {
        std::string_view sign;
        std::int64_t (*of)(std::int64_t a, std::int64_t b);
    };
    using Level = std::vector<Operator>;
    Number lost() {
        is_lost_ = true;
        return {};
    }
    [[nodiscard]] bool is_next(std::string_view token) const { return at_ < tokens_.size() && tokens_[at_] == token; }
    bool takes(std::string_view token) {
        const bool found = is_next(token);
        at_ += found ? 1U : 0U;
        return found;
    }

    Number chain(std::size_t level) {
        using I = std::int64_t;
        static const std::array<Level, 10> levels{
            {{{"||", [](I a, I b) { return I{a != 0 || b != 0}; }}},
             {{"&&", [](I a, I b) { return I{a != 0 && b != 0}; }}},
             {{"|", [](I a, I b) { return a | b; }}},
             {{"^", [](I a, I b) { return a ^ b; }}},
             {{"&", [](I a, I b) { return a & b; }}},
             {{"==", [](I a, I b) { return I{a == b}; }}, {"!=", [](I a, I b) { return I{a != b}; }}},
             {{"<", [](I a, I b) { return I{a < b}; }},
              {">", [](I a, I b) { return I{a > b}; }},
              {"<=", [](I a, I b) { return I{a <= b}; }},
              {">=", [](I a, I b) { return I{a >= b}; }}},
             {{"<<", [](I a, I b) { return a << b; }}, {">>", [](I a, I b) { return a >> b; }}},
             {{"+", [](I a, I b) { return a + b; }}, {"-", [](I a, I b) { return a - b; }}},
             {{"*", [](I a, I b) { return a * b; }}, {"/", [](I a, I b) { return a / b; }}, {"%", [](I a, I b) {
                                                                                                 return a % b;
                                                                                             }}}}};
        if (level == levels.size())
            return unary();
        Number left = chain(level + 1);
        for (;;) {
            const Level& operators = levels.at(level);
            const auto found = std::ranges::find_if(operators, [&](const Operator& one) { return is_next(one.sign); });
            if (found == operators.end())
                return left;
            ++at_;
            left = of(*found, left, chain(level + 1));
        }
    }
    static Number of(const Operator& by, Number a, Number b) {
        const auto is_either = [&](bool truth) { return (a && (*a != 0) == truth) || (b && (*b != 0) == truth); };
        if (by.sign == "&&" && is_either(false))
            return 0;
        if (by.sign == "||" && is_either(true))
            return 1;
        const bool divides = by.sign == "/" || by.sign == "%", shifts = by.sign == "<<" || by.sign == ">>";
        if (!a || !b || (divides && *b == 0) || (shifts && (*b < 0 || *b > 31)))
            return {};
        return in_32_bits(by.of(*a, *b));
    }
    static Number in_32_bits(std::int64_t x) { return x == static_cast<std::int32_t>(x) ? Number(x) : Number(); }
    Number unary() {
        if (++depth_ > deepest || at_ == tokens_.size())
            return lost();
        const auto inside = [&](auto change) {
            const Number x = unary();
            return x ? in_32_bits(change(*x)) : Number();
        };
        Number found;
        if (takes("!"))
            found = inside([](std::int64_t x) { return std::int64_t{x == 0}; });
        else if (takes("-"))
            found = inside([](std::int64_t x) { return -x; });
        else if (takes("~"))
            found = inside([](std::int64_t x) { return ~x; });
        else if (takes("+"))
            found = unary();
        else if (takes("("))
            found = bracketed();
        else if (takes("defined"))
            found = is_defined();
        else
            found = operand(tokens_[at_++]);
        --depth_;
        return found;
    }
    Number bracketed() {
        const Number found = chain(0);
        return takes(")") ? found : lost();
    }
    Number is_defined() {
        const bool brackets = takes("(");
        if (at_ == tokens_.size() || !is_word(tokens_[at_]))
            return lost();
        const std::string& name = tokens_[at_++];
        if (brackets && !takes(")"))
            return lost();
        if (const auto macro = macros_.find(name); macro != macros_.end())
            return macro->second.is_sure ? Number(1) : Number();
        return may_be_given(name) ? Number() : Number(0);
    }
    Number operand(const std::string& token) {
        if (is_word(token))
            return {};
        std::string_view digits = token;
        if (digits.ends_with('u') || digits.ends_with('U'))
            digits.remove_suffix(1);
        const bool is_hex = digits.starts_with("0x") || digits.starts_with("0X");
        const int base = is_hex ? 16 : digits.starts_with('0') ? 8 : 10;
        if (is_hex)
            digits.remove_prefix(2);
        std::int64_t value = 0;
        const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
        return status == std::errc{} && end == digits.data() + digits.size() ? in_32_bits(value) : lost();
    }

    const Tokens& tokens_;
    const Macros& macros_;
    int depth_ = 0;
    std::size_t at_ = 0;
    bool is_lost_ = false;
};

/// A stage's lines, one after the other.
class Branches {
  public:
    /// Whether the line is taken, or may be.
    bool take(const std::string& line) {
        const Tokens tokens = tokens_of(line);
        if (tokens.size() < 2 || tokens[0] != "#")
            return is_taken();
        const std::string& name = tokens[1];
        const Tokens rest(tokens.begin() + 2, tokens.end());
        if (name == "if" || name == "ifdef" || name == "ifndef") {
            open_.push_back({is_taken()});
            turn(open_.back().outside ? asked(name, rest) : Number(0));
        } else if (name == "elif" && !open_.empty()) {
            turn(open_.back().outside && open_.back().may_be_next ? asked("if", rest) : Number(0));
        } else if (name == "else" && !open_.empty()) {
            turn(1);
        } else if (name == "endif" && !open_.empty()) {
            open_.pop_back();
        } else if (is_taken() && !rest.empty()) {
            note(name, rest, line);
        }
        return is_taken();
    }

  private:
    struct Open {
        bool outside;            ///< whether what it lies in is taken
        bool may_be_next = true; ///< whether a branch behind those so far may be the one
        bool is_taken = false, is_sure = true;
    };
    [[nodiscard]] bool is_taken() const { return open_.empty() || open_.back().is_taken; }
    [[nodiscard]] bool is_sure() const {
        return std::ranges::all_of(open_, [](const Open& one) { return one.is_sure; });
    }
    void turn(Number condition) {
        Open& branch = open_.back();
        branch.is_taken = branch.outside && branch.may_be_next && (!condition || *condition != 0);
        branch.is_sure = branch.is_sure && condition.has_value();
        branch.may_be_next = branch.may_be_next && (!condition || *condition == 0);
    }
    [[nodiscard]] Number asked(const std::string& name, const Tokens& tokens) const {
        if (name == "if") {
            Tokens expanded;
            return expand(tokens, macros_, expanded) ? Condition(expanded, macros_).value() : Number();
        }
        if (tokens.empty())
            return {};
        const Number is_defined = Condition(Tokens{"defined", tokens[0]}, macros_).value();
        return is_defined && name == "ifndef" ? Number(1 - *is_defined) : is_defined;
    }
    /// A macro that may or may not be so has no value that is known.
    void note(const std::string& name, const Tokens& rest, const std::string& line) {
        if (name == "version")
            macros_["__VERSION__"] = {Tokens{rest[0]}};
        if (name != "define" && name != "undef")
            return;
        const std::string& macro = rest[0];
        const std::size_t behind = line.find(macro, line.find(name) + name.size()) + macro.size();
        if (!is_sure()) {
            const auto known = macros_.find(macro);
            if (known != macros_.end())
                known->second = {{}, known->second.is_sure && name == "define"};
            else if (name == "define")
                macros_[macro] = {{}, false};
        } else if (name == "undef") {
            macros_.erase(macro);
        } else if (behind < line.size() && line[behind] == '(') {
            macros_[macro] = {};
        } else {
            macros_[macro] = {Tokens(rest.begin() + 1, rest.end())};
        }
    }

    Macros macros_;
    std::vector<Open> open_;
};

/// A stage's lines as its preprocessor has them: a backslash at a line's end joins two, a comment over lines is a
/// space.
class LogicalLines {
  public:
    explicit LogicalLines(std::string_view text) : text_(text) {}

    /// False at the end.
    bool next() {
        line_.clear();
        parts_.clear();
        bool in_line_comment = false, in_block_comment = false, began_in_comment = false;
        for (; at_ < text_.size(); ++at_) {
            const std::size_t joint = joint_length();
            if (joint > 0 || text_[at_] == '\n') {
                if (!began_in_comment)
                    note();
                ++physical_;
                began_in_comment = in_block_comment || (in_line_comment && joint > 0);
                if (joint > 0) {
                    at_ += joint - 1;
                } else if (!in_block_comment) {
                    ++at_;
                    return true;
                }
            } else if (in_block_comment) {
                in_block_comment = !takes("*/");
            } else if (!in_line_comment) {
                note();
                in_line_comment = takes("//");
                in_block_comment = !in_line_comment && takes("/*");
                line_ += in_line_comment || in_block_comment ? ' ' : text_[at_];
            }
        }
        return !parts_.empty();
    }
    [[nodiscard]] const std::string& line() const { return line_; }
    /// The lines of the text, from 0, that it comes of; not those within a comment.
    [[nodiscard]] const std::vector<std::size_t>& parts() const { return parts_; }

  private:
    /// Of a backslash and the end of a line; 0: there is none.
    [[nodiscard]] std::size_t joint_length() const {
        const std::string_view rest = text_.substr(at_);
        return rest.starts_with("\\\n") ? 2 : rest.starts_with("\\\r\n") ? 3 : 0;
    }
    bool takes(std::string_view sign) {
        if (!text_.substr(at_).starts_with(sign))
            return false;
        ++at_; // the loop takes its second character
        return true;
    }
    void note() {
        if (parts_.empty() || parts_.back() != physical_)
            parts_.push_back(physical_);
    }

    std::string_view text_;
    std::size_t at_ = 0, physical_ = 0;
    std::string line_;
    std::vector<std::size_t> parts_;
};

} // namespace

std::vector<bool> taken_files(const ShaderSource& stage) {
    std::vector<bool> taken(stage.files.size(), true);
    if (stage.module != nullptr)
        return taken;
    for (const ShaderSource::Origin& origin : stage.origins)
        taken[origin.file] = false;
    Branches branches;
    for (LogicalLines lines(stage.text); lines.next();)
        if (branches.take(lines.line()))
            for (const std::size_t part : lines.parts())
                taken[stage.origins[part].file] = true;
    return taken;
}

} // namespace lockstep
