#include "lockstep/system_program.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"

namespace lockstep {
namespace {

constexpr std::string_view help =
    R"(usage: {0} check [--frames N] [--mode resync|free] [--legal measured|glsl|any_order] [--shaders DIR] [--gl NAME]
             [--json FILE] [--capsule FILE] [--allow-undefined]
       {0} explain --frame N --item N [--pass N] [--shaders DIR] [--gl NAME] [--legal NAME] [--hex]
       {0} capsule FILE [--hex]

check runs the shaders beside their twins, pass by pass, and compares every bit; --capsule keeps the first item that is
divergent. explain shows one item's step, value by value. capsule judges a kept one again, without GL.
Exit status: 0 it passed, 1 it did not, 2 it could not be run.
)";

/// The words after the verb: --NAME VALUE, flags, and what stands by itself.
class Arguments {
  public:
    Arguments(int argc, char** argv) {
        for (int i = 2; i < argc; ++i) {
            const std::string_view word = argv[i];
            if (!word.starts_with("--")) {
                alone_.emplace_back(word);
            } else if (word == "--hex" || word == "--allow-undefined") {
                given_[std::string(word)] = "";
            } else {
                if (i + 1 == argc)
                    throw Error(fmt::format("{} needs a value", word));
                if (!given_.emplace(word, argv[++i]).second)
                    throw Error(fmt::format("{} is given twice", word));
            }
        }
    }
    /// Throws Error for an option that the verb does not have.
    void allow(std::initializer_list<std::string_view> options, std::size_t alone) const {
        for (const auto& [name, value] : given_)
            if (std::find(options.begin(), options.end(), name) == options.end())
                throw Error(
                    fmt::format("there is no option {}; there are {}", plain_line(name), fmt::join(options, ", ")));
        if (alone_.size() != alone)
            throw Error(alone_.size() < alone
                            ? std::string("a file is missing; see help")
                            : fmt::format("'{}' is not expected; see help", plain_line(alone_.back())));
    }
    [[nodiscard]] bool has(const std::string& name) const { return given_.contains(name); }
    [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise = "") const {
        const auto found = given_.find(name);
        return found == given_.end() ? otherwise : found->second;
    }
    [[nodiscard]] int number(const std::string& name, std::optional<int> otherwise = {}) const {
        const auto found = given_.find(name);
        if (found == given_.end()) {
            if (!otherwise)
                throw Error(fmt::format("{} is missing", name));
            return *otherwise;
        }
        int value = -1;
        const std::string& word = found->second;
        const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (status != std::errc{} || end != word.data() + word.size() || value < 0)
            throw Error(fmt::format("{}: '{}' is not a whole number from 0 up", name, plain_line(word)));
        return value;
    }
    [[nodiscard]] const std::vector<std::string>& alone() const { return alone_; }

  private:
    std::map<std::string, std::string> given_;
    std::vector<std::string> alone_;
};

Legal legal_of(const Arguments& arguments) {
    static const std::map<std::string, Legal> names{
        {"measured", Legal::measured}, {"glsl", Legal::glsl}, {"any_order", Legal::any_order}};
    const std::string name = arguments.text("--legal", "measured");
    if (!names.contains(name))
        throw Error(fmt::format("--legal: '{}' is not one of measured, glsl, any_order", plain_line(name)));
    return names.at(name);
}

NumberFormat format_of(const Arguments& arguments) {
    return arguments.has("--hex") ? NumberFormat::hexadecimal : NumberFormat::decimal;
}

/// One run of the program.
class SystemProgram {
  public:
    /// `words`: of the command line, after the program's name.
    SystemProgram(const System& system, const std::vector<GlPass>& passes, std::string shaders,
                  std::vector<std::string> words)
        : system_(system), passes_(passes), shaders_(std::move(shaders)), words_(std::move(words)) {}

    int check_verb(const Arguments& arguments) {
        arguments.allow(
            {"--frames", "--mode", "--legal", "--shaders", "--gl", "--json", "--capsule", "--allow-undefined"}, 0);
        const std::string mode = arguments.text("--mode", "resync");
        if (mode != "resync" && mode != "free")
            throw Error(fmt::format("--mode: '{}' is not one of resync, free", plain_line(mode)));
        MatchOptions options;
        options.frames = arguments.number("--frames", 60);
        options.mode = mode == "free" ? CheckMode::free : CheckMode::resync;
        options.legal = legal_of(arguments);
        options.allow_undefined = arguments.has("--allow-undefined");
        const Gl gl = open_gl(arguments);
        GlSystemSide side(gl, system_, passes_, folder(arguments));
        OutputFiles files;
        files.protect(folder(arguments));
        for (const char* output : {"--json", "--capsule"})
            if (arguments.has(output))
                files.expect(arguments.text(output));
        options.repeat = this_program(words_);
        const MatchResult result = match_system(side, system_, options);
        fmt::print("{}", result.text());
        if (arguments.has("--json"))
            files.write(arguments.text("--json"), json_text(report_json(result.report(), result.run())));
        if (arguments.has("--capsule"))
            keep_capsule(result.report(), side, options.legal, arguments.text("--capsule"), files);
        files.commit();
        return result.passed() ? 0 : 1;
    }

    int explain_verb(const Arguments& arguments) {
        arguments.allow({"--frame", "--item", "--pass", "--shaders", "--gl", "--legal", "--hex"}, 0);
        const Gl gl = open_gl(arguments);
        GlSystemSide side(gl, system_, passes_, folder(arguments));
        SystemRun run(system_, side, known_operations(legal_of(arguments), side.describe().profile),
                      arguments.number("--frame"), static_cast<std::size_t>(arguments.number("--pass", 0)));
        fmt::print("{}", explain_item(run, static_cast<std::size_t>(arguments.number("--item")), format_of(arguments)));
        return 0;
    }

    int capsule_verb(const Arguments& arguments) {
        arguments.allow({"--hex"}, 1);
        const ItemCapsule capsule = load_item_capsule(arguments.alone().front(), system_);
        fmt::print("{}\n{}", capsule.renderer, item_capsule_text(capsule, system_, format_of(arguments)));
        return judge(capsule, system_).kind == DifferenceClass::divergent ? 1 : 0;
    }

  private:
    static Gl open_gl(const Arguments& arguments) {
        Gl gl(arguments.text("--gl"));
        if (!gl)
            throw Error(gl.missing());
        return gl;
    }
    [[nodiscard]] std::string folder(const Arguments& arguments) const { return arguments.text("--shaders", shaders_); }

    void keep_capsule(const CheckReport& report, SystemSide& side, Legal legal, const std::string& path,
                      OutputFiles& files) {
        if (!report.verdicts || !report.verdicts->first) {
            fmt::print("capsule   none: nothing is divergent\n");
            return;
        }
        const Place& place = report.verdicts->first->place;
        const std::size_t pass = report.verdicts->first->pass;
        SystemRun run(system_, side, known_operations(legal, side.describe().profile), place.frame, pass);
        files.write(path, item_capsule_file(cut_item_capsule(run, place.index, side.describe().name), system_));
        fmt::print("capsule   {} {} of frame {}\n", system_.schema.resources[place.resource].item, place.index,
                   place.frame);
    }

    const System& system_;
    const std::vector<GlPass>& passes_;
    std::string shaders_;
    std::vector<std::string> words_;
};

} // namespace

int run_system_program(int argc, char** argv, const System& system, const std::vector<GlPass>& passes,
                       const std::string& shaders) {
    const std::string name = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : system.schema.system;
    const std::string_view verb = argc > 1 ? argv[1] : "help";
    try {
        SystemProgram program(system, passes, shaders, {argv + std::min(argc, 1), argv + argc});
        const Arguments arguments(argc, argv);
        if (verb == "check")
            return program.check_verb(arguments);
        if (verb == "explain")
            return program.explain_verb(arguments);
        if (verb == "capsule")
            return program.capsule_verb(arguments);
        if (verb != "help" && verb != "--help")
            throw Error(
                fmt::format("there is no verb '{}'; there are check, explain, capsule, help", plain_line(verb)));
        fmt::print(fmt::runtime(help), name);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", name, plain_line(error.what()));
        return 2;
    }
}

} // namespace lockstep
