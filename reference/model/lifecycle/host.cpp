#include "reference/model/lifecycle/host.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "reference/model/error.hpp"
#include "reference/model/lifecycle/bounding_polygon.hpp"
#include "reference/model/lifecycle/half.hpp"
#include "reference/model/lifecycle/layout.hpp"
#include "reference/model/random.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr std::size_t longest_window = std::size_t{1} << 22U;

/// As the layout's time is stored.
float stored(const Settings& settings, float x) {
    if (plan_of(settings.switches.layout).floats)
        return x;
    // A dithered step is at least that toward zero.
    const HalfRounding rounding = settings.switches.half_rounding;
    return half_value(half_code(x, rounding == HalfRounding::dithered ? HalfRounding::toward_zero : rounding));
}

/// How many ticks fit into a lifetime. The tick is a float: it may stand for one half an ULP shorter, as for 1/60.
std::size_t nominal_age(float shortest, float tick) {
    return static_cast<std::size_t>(std::max(0.0, std::floor(double{shortest} / (double{tick} * (1.0 - 0x1p-24)))));
}

bool counts_ticks(const Settings& s) {
    return !plan_of(s.switches.layout).floats && s.switches.time_code == TimeCode::ticks16;
}

HullPoints hull_points(HullOf chosen, Sprite::Filter filter) {
    if (chosen == HullOf::by_filter)
        return filter == Sprite::Filter::nearest ? HullPoints::corners : HullPoints::bilinear;
    return static_cast<HullPoints>(chosen);
}

std::vector<glm::vec2> corners_of(const Sprite& sprite, HullOf chosen) {
    if (sprite.polygon == 0)
        return {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}};
    std::vector<std::uint8_t> alpha;
    for (const Rgba8& texel : sprite.texture.texels)
        alpha.push_back(texel.a);
    const int side = sprite.texture.width;
    const auto points = outermost(alpha, side, sprite.alpha_cut, hull_points(chosen, sprite.filter));
    std::vector<glm::vec2> corners;
    for (const glm::dvec2 corner : sprite_polygon(convex_hull(points), sprite.polygon))
        corners.emplace_back(corner / double(side));
    return corners;
}

} // namespace

std::optional<std::size_t> dying_age(const Settings& settings, float shortest) {
    if (counts_ticks(settings))
        return static_cast<std::size_t>(std::clamp(std::floor(shortest / settings.tick + 0.5F), 0.0F, 65535.0F));
    float remaining = stored(settings, shortest);
    for (std::size_t ticks = 0; ticks <= longest_window; ++ticks) {
        if (!(remaining > 0.0F))
            return ticks;
        const float next = stored(settings, remaining - settings.tick);
        if (next == remaining)
            return {};
        remaining = next;
    }
    return {};
}

HostEmitter::HostEmitter(const Settings& all, std::size_t number_)
    : number(number_), settings_(all.emitters[number_]), tick_(all.tick), drag_(all.switches.drag),
      rate_(settings_.rate, all.tick) {
    seed = static_cast<std::uint32_t>(splitmix64(all.seed ^ number));
    const Switches& s = all.switches;
    slots = settings_.capacity;
    if (s.overflow == Overflow::replace_oldest)
        slots += largest_request();
    blocks = (slots + 255) / 256;
    if (s.management == Management::index_lists && settings_.draw == Emitter::Draw::ribbon)
        keys = std::bit_ceil(slots);
    kills = std::any_of(settings_.forces.begin(), settings_.forces.end(),
                        [](const Force& f) { return f.kind == Force::Kind::attraction && f.kill_radius > 0.0F; });
    kills = kills || (settings_.simulation && output_named(*settings_.simulation, "kill") != nullptr);
    const std::optional<std::size_t> age = s.may_die == MayDie::nominal
                                               ? std::optional(nominal_age(settings_.lifetime[0], all.tick))
                                               : dying_age(all, settings_.lifetime[0]);
    if (s.may_die == MayDie::all || kills || s.overflow == Overflow::replace_oldest ||
        s.management == Management::index_lists || (age && *age == 0))
        dies = Dies::all;
    else if (!age || *age > longest_window)
        dies = Dies::none;
    else
        window = *age;
    basis = basis_of(settings_.direction);
    cone_depth = depth_of_cone(std::max(0.0F, settings_.cone));
}

std::uint32_t HostEmitter::request(int frame) const {
    std::uint64_t all = rate_.count(frame);
    for (const auto& [when, count] : settings_.bursts)
        all += when == frame ? count : 0;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(all, 1U << 24U));
}

std::uint32_t HostEmitter::largest_request() const {
    std::uint64_t most = 0;
    std::map<int, std::uint64_t> of_frames;
    for (const auto& [frame, count] : settings_.bursts)
        most = std::max(most, of_frames[frame] += count);
    const auto rate = static_cast<std::uint64_t>(settings_.rate * tick_) + 1;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(most + rate, 1U << 24U));
}

glm::vec3 HostEmitter::origin(int frame) const {
    const std::vector<Place>& path = settings_.path;
    if (path.empty())
        return glm::vec3(0.0F);
    if (frame <= path.front().frame)
        return path.front().position;
    for (std::size_t k = 1; k < path.size(); ++k)
        if (frame <= path[k].frame) {
            const double share = double(frame - path[k - 1].frame) / double(path[k].frame - path[k - 1].frame);
            const glm::dvec3 from(path[k - 1].position), to(path[k].position);
            return glm::vec3(from + (to - from) * share);
        }
    return path.back().position;
}

glm::vec3 HostEmitter::origin_velocity(int frame) const {
    return glm::vec3((glm::dvec3(origin(frame)) - glm::dvec3(origin(frame - 1))) / tick_);
}

std::vector<HostForce> HostEmitter::forces(int frame) const {
    std::vector<HostForce> all;
    for (const Force& f : settings_.forces) {
        HostForce h{.kind = f.kind, .centre = f.centre, .strength = f.strength, .radius = f.radius};
        h.falloff = static_cast<float>(f.falloff);
        switch (f.kind) {
        case Force::Kind::drag:
            h.drag = drag_ == Drag::explicit_force ? f.k
                     : drag_ == Drag::implicit     ? static_cast<float>(1.0 / (1.0 + double{f.k} * tick_))
                                                   : static_cast<float>(std::exp(-double{f.k} * tick_));
            break;
        case Force::Kind::vortex:
            h.axis = glm::vec3(glm::normalize(glm::dvec3(f.axis)));
            h.pull = f.pull;
            break;
        case Force::Kind::attraction:
            h.pull = f.kill_radius;
            if (f.inverse_square)
                h.square = static_cast<float>(double{f.softening} * double{f.softening});
            break;
        case Force::Kind::curl_noise:
            h.centre = glm::vec3(glm::dvec3(f.pan) * (double(frame) * tick_));
            h.radius = f.frequency;
            h.seed = static_cast<float>(f.seed);
            break;
        }
        all.push_back(h);
    }
    return all;
}

bool counts_in_simulation(const Host& host, const HostEmitter& of) {
    return of.kills ||
           (host.switches().position_code == PositionCode::box16 && !plan_of(host.switches().layout).floats);
}

Host::Host(Settings settings) : settings_(std::move(settings)) {
    check(settings_);
    sprite_corners_ = corners_of(settings_.sprite, settings_.switches.hull_points);
    std::size_t base = 0, block = 0, in_ring = 0, key = 0;
    for (std::size_t e = 0; e < settings_.emitters.size(); ++e) {
        HostEmitter& one = emitters_.emplace_back(settings_, e);
        if (one.slots > most_particles_of_emitter)
            throw Error(fmt::format("emitter {}: capacity and largest request are {} particles; right is at most {}", e,
                                    one.slots, most_particles_of_emitter));
        one.base = base;
        one.first_block = block;
        one.first_in_ring = in_ring;
        one.first_key = key;
        base += one.slots;
        if (base > most_particles_of_emitter)
            throw Error(fmt::format("emitter {}: {} particles up to here; a scene has at most {}", e, base,
                                    most_particles_of_emitter));
        block += one.blocks;
        key += one.keys;
        in_ring += std::max<std::size_t>(one.window, 1);
    }
}

std::size_t Host::slots() const { return emitters_.back().base + emitters_.back().slots; }
std::size_t Host::blocks() const { return emitters_.back().first_block + emitters_.back().blocks; }
std::size_t Host::ring() const {
    return emitters_.back().first_in_ring + std::max<std::size_t>(emitters_.back().window, 1);
}

std::size_t Host::keys() const { return emitters_.back().first_key + emitters_.back().keys; }

bool Host::has_ribbons() const {
    return std::any_of(emitters_.begin(), emitters_.end(),
                       [](const HostEmitter& of) { return of.settings().draw == Emitter::Draw::ribbon; });
}

float Host::time(int frame) const { return static_cast<float>(double(frame) * double{settings_.tick}); }

glm::vec3 Host::box_scale() const { return glm::vec3(65535.0 / glm::dvec3(settings_.box_size)); }
glm::vec3 Host::box_step() const { return glm::vec3(glm::dvec3(settings_.box_size) / 65535.0); }

} // namespace lockstep::lifecycle
