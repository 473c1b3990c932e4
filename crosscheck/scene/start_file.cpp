#include "crosscheck/scene/start_file.hpp"

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/files/number_table.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

enum StartColumn : std::size_t { in_position, in_direction, in_speed, in_velocity, in_collide_time };

const std::vector<TableColumn>& start_columns() {
    static const std::vector<TableColumn> all{{.name = "position", .components = 3},
                                              {.name = "direction", .components = 3, .optional = true},
                                              {.name = "speed", .optional = true},
                                              {.name = "velocity", .components = 3, .optional = true},
                                              {.name = "collide_time", .optional = true}};
    return all;
}

std::string place_of(const NumberTable& table, std::size_t row) {
    return table.lines.empty() ? fmt::format("{}: /{}", table.file, row)
                               : fmt::format("{}:{}", table.file, table.lines[row]);
}

void check_finite(const NumberTable& table) {
    for (std::size_t row = 0; row < table.rows; ++row)
        for (std::size_t c = 0; c < table.words.size(); ++c) {
            const auto components = static_cast<std::size_t>(start_columns()[c].components);
            for (std::size_t k = 0; k < components && !table.words[c].empty(); ++k) {
                const auto value = std::bit_cast<float>(table.words[c][row * components + k]);
                if (!std::isfinite(value))
                    throw Error(fmt::format("{}: particle {}: {} is {}; right is a finite number", place_of(table, row),
                                            row, start_columns()[c].name, value));
            }
        }
}

/// As of an emitter; a particle without speed needs no direction.
void check_motion(const NumberTable& table, const Particles& particles) {
    for (std::size_t row = 0; row < table.rows; ++row) {
        const auto wrong = [&](const std::string& what) {
            throw Error(fmt::format("{}: particle {}: {}", place_of(table, row), row, what));
        };
        const float speed = particles.speed[row];
        if (speed < 0.0F)
            wrong(fmt::format("speed is {}; right is a number from 0 up", speed));
        if (speed > 0.0F && !(glm::length(glm::dvec3(particles.direction[row])) > 0.0))
            wrong(fmt::format("direction has no length, and speed is {}; right is a length above 0", speed));
    }
}

void check_columns(const NumberTable& table) {
    const auto has = [&](StartColumn column) { return !table.words[column].empty(); };
    const bool right = has(in_velocity) ? !has(in_direction) && !has(in_speed) : has(in_direction) && has(in_speed);
    if (!right)
        throw Error(fmt::format("{}: it has {}; right are position and either direction and speed, or velocity",
                                table.file,
                                has(in_velocity)    ? "velocity, and direction or speed beside it"
                                : has(in_direction) ? "direction without speed"
                                : has(in_speed)     ? "speed without direction"
                                                    : "neither velocity nor direction and speed"));
}

/// Computed in double and rounded once; no direction where there is no speed.
void split(glm::vec3 whole, glm::vec3& along, float& fast) {
    const glm::dvec3 v(whole);
    const double length = glm::length(v);
    fast = static_cast<float>(length);
    along = length > 0.0 ? glm::vec3(v / length) : glm::vec3(0.0F);
}

} // namespace

void hold_velocity(Particles& particles, const Switches& switches) {
    if (switches.velocity != Velocity::vector)
        return;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles.direction[i] *= particles.speed[i];
        particles.speed[i] = 1.0F;
    }
}

Particles read_start(const std::filesystem::path& file, const Switches& switches) {
    const NumberTable table = read_number_table(file, start_columns(), "a start");
    check_columns(table);
    check_finite(table);
    const auto number = [&](StartColumn column, std::size_t at) {
        return std::bit_cast<float>(table.words[column][at]);
    };
    const auto vector = [&](StartColumn column, std::size_t row) {
        return glm::vec3(number(column, 3 * row), number(column, 3 * row + 1), number(column, 3 * row + 2));
    };
    const bool whole = !table.words[in_velocity].empty();
    Particles particles;
    particles.resize(table.rows);
    for (std::size_t i = 0; i < table.rows; ++i) {
        particles.position[i] = vector(in_position, i);
        particles.direction[i] = vector(whole ? in_velocity : in_direction, i);
        particles.speed[i] = whole ? 1.0F : number(in_speed, i);
        particles.collide_time[i] = table.words[in_collide_time].empty() ? 0.0F : number(in_collide_time, i);
        if (whole && switches.velocity != Velocity::vector)
            split(particles.direction[i], particles.direction[i], particles.speed[i]);
    }
    if (!whole) {
        check_motion(table, particles);
        hold_velocity(particles, switches);
    }
    return particles;
}

} // namespace lockstep
