#pragma once
#include "tests/dust/dust_run.hpp"

namespace lockstep::test {

/// Two rooms in which every kernel has something to do: turned boxes in one, axis-aligned ones in the other.
inline dust::Settings room(bool aabb) {
    using Kind = dust::Tool::Kind;
    dust::Settings s;
    s.count = 4000;
    s.mass = 1.25F;
    s.scale = 0.6F;
    s.switches.random = dust::Random::integer;
    s.gravity = {0.5F, -9.8F, 0.25F};
    s.colour_b = {0.5F, 0.75F, 1.0F};
    s.spawn = {{-14.0F, 1.0F, -12.0F}, {13.0F, 14.0F, 12.0F}};
    s.world = {{-15.0F, 0.0F, -15.0F}, {15.0F, 15.0F, 14.0F}};
    s.controller = {{0, {0.0F, 6.0F, -5.0F}, {0.1F, 0.1F, 1.0F}}, {60, {3.0F, 6.0F, -2.0F}, {0.5F, -0.2F, 1.0F}}};
    s.tools = {{.kind = Kind::vacuum, .from = 2, .to = 22, .force = 40.0F, .range = 16.0F, .death_range = 3.0F},
               {.kind = Kind::emit, .from = 22, .to = 34, .force = 30.0F, .angle = 30.0F, .distance = 3.0F},
               {.kind = Kind::wind, .from = 34, .to = 44, .force = 30.0F, .range = 12.0F, .angle = 40.0F}};
    for (const int frame : {0, 12, 30})
        s.cannon.push_back(
            {.frame = frame, .position = {0.0F, 8.0F, -6.0F}, .speed = 120.0F, .range = 14.0F, .force = 4000.0F});
    s.colliders = {{.position = {4.0F, 4.0F, 2.0F}, .radius = 3.0F},
                   {.position = {6.0F, 3.0F, 3.0F}, .radius = 2.5F},
                   {.sphere = false, .position = {-8.0F, 4.0F, -4.0F}, .scale = {6, 2, 4}, .rotate = {20, 10, 30}},
                   {.sphere = false, .position = {-6.0F, 5.0F, -6.0F}, .scale = {3, 5, 7}, .rotate = {0, 40, 15}},
                   {.sphere = false, .position = {7.0F, 5.0F, -3.0F}, .scale = {5, 5, 5}, .rotate = {5, 0, 0}}};
    if (aabb) {
        s.switches.box_kind = dust::BoxKind::aabb;
        s.switches.box_detect = dust::BoxDetect::rounded;
    }
    return s;
}

/// Of a run in which each of a room's kernels has its turn.
constexpr int frames = 50;

} // namespace lockstep::test
