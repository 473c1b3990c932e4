#include <catch2/catch.hpp>

#include <cstring>

#include <nlohmann/json.hpp>

#include "crosscheck/collision/record/trace_messages.hpp"
#include "reference/model/error.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::trace_messages_test {

using Catch::Contains;

namespace {

/// What a reading process might say, good or bad.
class Script : public ByteSource {
  public:
    template <class Value> Script& say(MessageKind kind, std::uint32_t index, const std::vector<Value>& values) {
        const MessageHead head{kind, index, values.size() * sizeof(Value)};
        append(&head, sizeof head);
        append(values.data(), head.bytes);
        return *this;
    }
    Script& say(MessageKind kind, const std::string& text) {
        return say(kind, 0, std::vector<char>(text.begin(), text.end()));
    }
    Script& head(MessageKind kind, std::uint32_t index, std::uint64_t bytes) {
        const MessageHead head{kind, index, bytes};
        append(&head, sizeof head);
        return *this;
    }

    void read(void* into, std::size_t bytes) override {
        if (bytes > bytes_.size() - at_)
            throw Error("it fell silent");
        std::memcpy(into, bytes_.data() + at_, bytes);
        at_ += bytes;
    }

  private:
    void append(const void* bytes, std::size_t count) { bytes_.append(static_cast<const char*>(bytes), count); }
    std::string bytes_;
    std::size_t at_ = 0;
};

nlohmann::json contents() {
    return {{"rows", 3},
            {"particles", 2},
            {"has_cdt", 0},
            {"has_obstacles", 0},
            {"has_roots", 0},
            {"scene", "{}"},
            {"name", "it"},
            {"profile", ""},
            {"renderer", ""},
            {"settings", ""},
            {"probe", ""},
            {"program", ""},
            {"warnings", nlohmann::json::array()}};
}

nlohmann::json with(const char* key, const nlohmann::json& value) {
    nlohmann::json json = contents();
    json[key] = value;
    return json;
}

const std::vector<float> two_particles(16, 1.0F);

std::string refusal(Script& script) {
    return test::error_of([&] { read_contents(script, "run.h5"); });
}
std::string refusal(const nlohmann::json& json) {
    Script script;
    script.say(MessageKind::contents, json.dump()).say(MessageKind::particles, 0, two_particles);
    return refusal(script);
}

} // namespace

TEST_CASE("trace messages: what fits together is taken") {
    CHECK(refusal(contents()).empty());
    Script script;
    script.say(MessageKind::contents, with("has_obstacles", 1).dump())
        .say(MessageKind::positions, 0, std::vector<float>(9, 0.5F))
        .say(MessageKind::triangles, 0, std::vector<std::uint32_t>{0, 1, 2})
        .say(MessageKind::particles, 0, two_particles);
    const TraceInfo info = read_contents(script, "run.h5");
    CHECK(info.frames == 2);
    CHECK(info.scene.start.size() == 2);
    CHECK(info.scene.obstacles.triangle_count() == 1);
}

TEST_CASE("trace messages: what a broken reading process says is no more than an error") {
    CHECK_THAT(refusal(with("rows", 1)), Contains("run.h5: /rows: 1 is not an integer from 2"));
    CHECK_THAT(refusal(with("particles", 0)), Contains("/particles"));
    CHECK_THAT(refusal(with("particles", 1'000'000'000)), Contains("/particles"));
    CHECK_THAT(refusal(with("particles", 3)), Contains("another number of particles"));
    CHECK_THAT(refusal(with("scene", 7)), Contains("/scene: 7 is not a text"));
    CHECK_THAT(refusal(with("warnings", {1})), Contains("/warnings/0"));
    CHECK_THAT(refusal(with("has_cdt", 1)), Contains("\"cdt_width\" is missing"));
    CHECK_THAT(refusal(with("has_cdt", 2)), Contains("/has_cdt"));
    CHECK_THAT(refusal(with("has_roots", 1)), Contains("answers what nobody asked"));
    CHECK_THAT(refusal(with("profile", "[")), Contains("profile:1:1: malformed JSON"));

    Script silent;
    CHECK(refusal(silent) == "it fell silent");
    Script tells;
    tells.say(MessageKind::error, "speed: missing");
    CHECK(refusal(tells) == "run.h5: speed: missing");
    Script endless;
    endless.head(MessageKind::contents, 0, UINT64_MAX);
    CHECK_THAT(refusal(endless), Contains("a text without end"));
    Script unknown;
    unknown.head(static_cast<MessageKind>(99), 0, 0);
    CHECK_THAT(refusal(unknown), Contains("answers what nobody asked"));
}

TEST_CASE("trace messages: obstacles are held to what the passes may index") {
    const auto with_mesh = [](const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles) {
        Script script;
        script.say(MessageKind::contents, with("has_obstacles", 1).dump())
            .say(MessageKind::positions, 0, positions)
            .say(MessageKind::triangles, 0, triangles)
            .say(MessageKind::particles, 0, two_particles);
        return refusal(script);
    };
    CHECK_THAT(with_mesh(std::vector<float>(9), {0, 1, 3}), Contains("triangles: names corner 3, there are 3"));
    CHECK_THAT(with_mesh(std::vector<float>(8), {0, 1, 2}), Contains("32 bytes where at most"));
    CHECK_THAT(with_mesh(std::vector<float>(9), {0, 1}), Contains("no whole number of triangles"));
    CHECK_THAT(with_mesh({0, 0, 0, 0, 0, 0, 0, 0, INFINITY}, {0, 1, 2}), Contains("not finite"));
    Script huge;
    huge.say(MessageKind::contents, with("has_obstacles", 1).dump()).head(MessageKind::positions, 0, 1ULL << 50U);
    CHECK_THAT(refusal(huge), Contains("bytes where at most"));
}

TEST_CASE("trace messages: a state of another frame or size is not taken for the one asked for") {
    Particles particles;
    particles.resize(2);
    CollisionImage cdt(2, 2);
    const auto particles_refusal = [&](Script& script) {
        return test::error_of([&] { read_particles(script, "run.h5", 5, particles); });
    };
    const auto cdt_refusal = [&](Script& script) {
        return test::error_of([&] { read_cdt(script, "run.h5", 5, cdt); });
    };
    Script good;
    CHECK(particles_refusal(good.say(MessageKind::particles, 5, two_particles)).empty());
    Script other;
    CHECK_THAT(particles_refusal(other.say(MessageKind::particles, 4, two_particles)), Contains("nobody asked"));
    Script larger;
    CHECK_THAT(particles_refusal(larger.say(MessageKind::particles, 5, std::vector<float>(24))),
               Contains("another number"));
    Script image;
    CHECK(cdt_refusal(image.say(MessageKind::cdt, 5, std::vector<float>(16))).empty());
    Script small;
    CHECK_THAT(cdt_refusal(small.say(MessageKind::cdt, 5, std::vector<float>(12))), Contains("a CDT of another size"));
    Script late;
    CHECK(cdt_refusal(late.say(MessageKind::error, "row 5: broken")) == "run.h5: row 5: broken");
}

} // namespace lockstep::test::trace_messages_test
