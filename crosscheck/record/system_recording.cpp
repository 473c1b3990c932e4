#include "crosscheck/record/system_recording.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/record/seal.hpp"
#include "crosscheck/record/system_file.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/schema_json.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr int most_frames = 100'000'000;
constexpr std::uint64_t longest_column = std::uint64_t{100'000'001} * sizeof(std::int32_t); // bytes

const char* const texts[] = {layout::system,  layout::schema,   layout::name,     layout::frames,  layout::scene,
                             layout::options, layout::renderer, layout::settings, layout::shaders, layout::profile};

/// Where two schemas first differ.
std::string difference(const json& recorded, const json& here) {
    const json changes = json::diff(recorded, here);
    const auto path = changes[0].at("path").get<std::string>();
    return path.empty() ? "/" : path;
}

} // namespace

std::string recorded_system(const std::filesystem::path& file) { return sealed_system(OpenedFile(file, "recording")); }

SystemRecording::SystemRecording(const std::filesystem::path& file, const std::string& system)
    : file_(file, "recording") {
    check_seal(file_, system);
    read_info(system);
    file_.expect_unchanged();
}

void SystemRecording::read_info(const std::string& system) {
    ReadingProcess process(file_, [this](ReadingEnd& end) {
        RecordedTexts recorded(file_);
        end.put_up_fence();
        json told{{"program", recorded.program()}};
        for (const char* text : texts)
            told[text] = recorded.text(text);
        const auto reciprocals = recorded.root_offsets(layout::reciprocals, reciprocal_count);
        const auto inverse_sqrts = recorded.root_offsets(layout::inverse_sqrts, inverse_sqrt_count);
        told["has_roots"] = !reciprocals.empty() && !inverse_sqrts.empty() ? 1 : 0;
        end.send(MessageKind::contents, told.dump(-1, ' ', false, json::error_handler_t::replace));
        if (told["has_roots"] == 1) {
            end.send(MessageKind::reciprocals, reciprocals);
            end.send(MessageKind::inverse_sqrts, inverse_sqrts);
        }
    });
    Messages messages(process, file());
    const std::string text = messages.text(messages.expect(MessageKind::contents));
    const json document = parse_json(text, file());
    const JsonValue told(document, file());
    const auto named = [&](const char* path) { return fmt::format("{}: {}", file(), path); };
    const auto json_of = [&](const char* path) {
        const std::string value = told.at(path).text();
        if (value.empty())
            throw Error(fmt::format("{}: missing; right is JSON", named(path)));
        return parse_json(value, named(path));
    };
    if (const std::string of = told.at(layout::system).text(); of != system)
        throw Error(fmt::format("{}: '{}', the seal says {}", named(layout::system), plain_line(of), system));
    program_ = told.at("program").label();
    schema_ = json_of(layout::schema);
    info_.name = told.at(layout::name).label();
    info_.settings = told.at(layout::settings).label();
    info_.renderer = told.at(layout::renderer).label();
    info_.shaders = told.at(layout::shaders).label();
    const std::string frames = told.at(layout::frames).text();
    const auto [rest, status] = std::from_chars(frames.data(), frames.data() + frames.size(), info_.frames);
    if (status != std::errc{} || rest != frames.data() + frames.size() || info_.frames < 1 ||
        info_.frames > most_frames)
        throw Error(fmt::format("{}: '{}' is no number of frames from 1 to {}", named(layout::frames),
                                plain_line(frames), most_frames));
    if (!told.at(layout::scene).text().empty()) {
        info_.scene = json_of(layout::scene);
        info_.options = json_of(layout::options);
    }
    const json profile = json_of(layout::profile);
    info_.profile = read_profile(JsonValue(profile, named(layout::profile)));
    if (told.at("has_roots").integer(0, 1) == 1) {
        const RootOffsets offsets{messages.values<std::int8_t>(MessageKind::reciprocals, reciprocal_count),
                                  messages.values<std::int8_t>(MessageKind::inverse_sqrts, inverse_sqrt_count)};
        if (offsets.reciprocal.size() != reciprocal_count || offsets.inverse_sqrt.size() != inverse_sqrt_count)
            messages.fail("its reading process broke: tables of another size");
        info_.profile.roots = std::make_shared<const RootTables>(root_tables(offsets));
    }
}

void SystemRecording::open(const System& system) {
    const json here = schema_json(system.schema);
    if (schema_ != here)
        throw Error(fmt::format("{}: {}: the state of {} is another here, first at {}", file(), layout::schema,
                                system.schema.system, plain_line(difference(schema_, here))));
    process_ = std::make_unique<ReadingProcess>(file_, [this, &system](ReadingEnd& end) {
        SystemFile states(file_, system.start);
        states.serve(end);
    });
    Messages messages(*process_, file());
    const std::string text = messages.text(messages.expect(MessageKind::contents));
    const json document = parse_json(text, file());
    const JsonValue told(document, file());
    for (const JsonValue& warning : told.at("warnings").items())
        warnings_.push_back(warning.label());
    std::vector<std::vector<std::int32_t>> frames, passes;
    for (std::size_t r = 0; r < system.schema.resources.size(); ++r) {
        frames.push_back(messages.values<std::int32_t>(MessageKind::frames, longest_column));
        passes.push_back(messages.values<std::int32_t>(MessageKind::passes, longest_column));
        if (frames.back().size() != passes.back().size() || frames.back().empty())
            messages.fail("its reading process broke: columns of another length");
    }
    expect_schedule(system, frames, passes);
    SystemState start = system.start;
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r) {
        read(r, 0, start[r]);
        const auto other = differing_items(system.start[r], std::as_const(start)[r]);
        if (!other.empty())
            throw Error(fmt::format("{}: {}: its row 0 is not the start of {}: {} is another", file(),
                                    layout::state(system.schema.resources[r]), system.name,
                                    item_name(system.schema.resources[r], start.extent(r), other.front())));
    }
}

/// Each row is of the frame and pass that leaves it in this system; counts the frames that are whole.
void SystemRecording::expect_schedule(const System& system, const std::vector<std::vector<std::int32_t>>& frames,
                                      const std::vector<std::vector<std::int32_t>>& passes) {
    const auto expect = [&](std::uint8_t r, std::size_t row, int frame, int pass) {
        if (frames[r][row] == frame && passes[r][row] == pass)
            return;
        throw Error(fmt::format("{}: {}: row {} is of frame {}, pass {}; in this system it is of frame {}, pass {}",
                                file(), layout::state(system.schema.resources[r]), row, frames[r][row], passes[r][row],
                                frame, pass));
    };
    std::vector<std::size_t> next(frames.size(), 1);
    for (std::uint8_t r = 0; r < frames.size(); ++r)
        expect(r, 0, -1, -1);
    const auto has_frame = [&](int frame) {
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            if (!system.passes[p]->runs(frame) || system.passes[p]->continues())
                continue;
            for (const std::uint8_t r : written_by(system, p)) {
                if (next[r] >= frames[r].size())
                    return false;
                expect(r, next[r]++, frame, static_cast<int>(p));
            }
        }
        return true;
    };
    while (frames_ < info_.frames && has_frame(frames_))
        ++frames_;
    if (frames_ == 0)
        throw Error(fmt::format("{}: holds no whole frame", file()));
    for (std::uint8_t r = 0; r < frames.size() && frames_ == info_.frames; ++r)
        if (next[r] < frames[r].size())
            throw Error(fmt::format("{}: {}: {} rows follow those of this system's passes", file(),
                                    layout::state(system.schema.resources[r]), frames[r].size() - next[r]));
    if (frames_ < info_.frames)
        warnings_.push_back(fmt::format("{} of the {} frames are there: read up to the last whole frame, {}", frames_,
                                        info_.frames, frames_ - 1));
}

void SystemRecording::read(std::uint8_t resource, std::size_t row, const WritableView& into) {
    process_->ask(MessageKind::row, static_cast<int>(row), resource);
    Messages messages(*process_, file());
    if (messages.expect(MessageKind::row, static_cast<std::uint32_t>(row)) != into.count() * item_bytes(into.about()))
        messages.fail("its reading process broke: another number of items");
    for (std::size_t f = 0; f < into.columns.size(); ++f)
        messages.fill(into.columns[f],
                      into.count() * static_cast<std::size_t>(into.fields()[f].components) * sizeof(std::uint32_t));
    file_.expect_unchanged();
}

void RecordedSide::upload(const SystemView& /*state*/) {
    state_ = system_.start;
    std::fill(next_.begin(), next_.end(), 1);
}

void RecordedSide::step(std::size_t pass, int frame) {
    if (frame >= recording_.frames())
        throw Error(fmt::format("{} holds frames 0 to {}, not {}", recording_.file(), recording_.frames() - 1, frame));
    if (system_.passes[pass]->continues() || !system_.passes[pass]->runs(frame))
        return;
    for (const std::uint8_t r : written_by(system_, pass))
        recording_.read(r, next_[r]++, state_[r]);
}

SideDescription RecordedSide::describe() const {
    return {fmt::format("recorded: {}", recording_.info().renderer), recording_.info().profile, {}, {}};
}

} // namespace lockstep
