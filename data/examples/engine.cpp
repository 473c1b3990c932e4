// A small engine that records itself with recording.hpp, as one on D3D or WebGPU would: rows of the image downwards,
// depth reversed, a camera and a time step of their own in each frame, velocities as vectors, the step in compute
// shaders. Usage: engine FILE.h5 [BUG]. Build: c++ -std=c++17 -O2 -ffp-contract=off engine.cpp -o engine
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>

#include "recording.hpp"

namespace {

constexpr int width = 96, height = 64, particles = 3000, frames = 36;
constexpr float range = 0.05F, speed_factor = 0.75F, collision_time = 0.05F, gravity = -0.98F;

struct Vec3 {
    float x = 0, y = 0, z = 0;
};
Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float length(Vec3 a) { return std::sqrt(dot(a, a)); }
Vec3 normalize(Vec3 a) { return a * (1 / std::sqrt(dot(a, a))); }

/// Column after column.
struct Matrix {
    float m[16] = {};
};

/// Looks at the origin from a circle round it; near 0.5, far 8, reversed: z / w is 1 at the near plane.
Matrix camera(int frame, bool orthographic) {
    const float angle = 0.05F * static_cast<float>(frame), c = std::cos(angle), s = std::sin(angle);
    constexpr float distance = 3, near = 0.5F, far = 8, focal = 2;
    // View: x' = c x - s z, y' = y, z' = s x + c z - distance.
    const float sx = focal * height / width, sy = focal;
    const float a = orthographic ? 1 / (far - near) : near / (far - near);
    const float b = orthographic ? far / (far - near) : near * far / (far - near);
    const float w = orthographic ? 0 : -1;
    const float scale = orthographic ? 1 / distance : 1;
    return {{sx * scale * c, 0, a * s, w * s,  //
             0, sy * scale, 0, 0,              //
             -sx * scale * s, 0, a * c, w * c, //
             0, 0, b - a * distance, orthographic ? 1 : distance}};
}

struct Clip {
    float x, y, z, w;
};
Clip project(const Matrix& matrix, Vec3 p) {
    const float* m = matrix.m;
    const auto row = [&](int r) { return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r]; };
    return {row(0), row(1), row(2), row(3)};
}

/// Where a position lies on the image; below 0 outside. Clip y goes up, rows go down.
int texel_of(Clip clip, bool upside_down) {
    const float u = (clip.x / clip.w + 1) * 0.5F;
    const float v = (1 - clip.y / clip.w) * 0.5F;
    const float x = u * width, y = (upside_down ? 1 - v : v) * height;
    const bool inside = x >= 0 && y >= 0 && x < width && y < height;
    return inside ? static_cast<int>(y) * width + static_cast<int>(x) : -1;
}

class Engine {
  public:
    explicit Engine(std::string bug) : bug_(std::move(bug)), positions_(particles), velocities_(particles) {
        std::uint32_t random = 1;
        const auto next = [&] {
            return static_cast<float>((random = random * 1664525 + 1013904223) >> 8) * 0x1p-23F - 1;
        };
        for (int i = 0; i < particles; ++i) {
            positions_[i] = Vec3{next(), next(), next()} * 0.9F;
            velocities_[i] = Vec3{next(), next(), next()} * 0.5F;
        }
    }

    void step(const Matrix& given, float tick) {
        const Matrix matrix = bug_ == "late_matrix" && frame_ > 0 ? earlier_ : given;
        const std::vector<float> image = image_;
        for (int i = 0; i < particles; ++i) {
            Vec3& position = positions_[i];
            Vec3& velocity = velocities_[i];
            float& collide_time = collide_times_[i];
            const int texel = texel_of(project(matrix, position), bug_ == "upside_down");
            const std::optional<Vec3> hit = collide_time < 0 ? nearest(image, position, texel) : std::nullopt;
            if (hit) {
                velocity = normalize(position - *hit) * (length(velocity) * speed_factor);
                collide_time = collision_time;
            } else {
                velocity = velocity + Vec3{0, gravity, 0} * tick;
                collide_time = collide_time - tick;
            }
            position = position + velocity * tick;
        }
        draw(matrix);
        earlier_ = given;
        ++frame_;
    }

    void record(recording::Recording& into) const {
        into.state(floats(positions_), floats(velocities_), collide_times_);
    }
    const std::vector<float>& image() const { return image_; }

  private:
    static std::vector<float> floats(const std::vector<Vec3>& vectors) {
        std::vector<float> all;
        for (const Vec3& v : vectors)
            all.insert(all.end(), {v.x, v.y, v.z});
        return all;
    }

    /// The nearest position round a texel that is in range.
    std::optional<Vec3> nearest(const std::vector<float>& image, Vec3 own, int texel) const {
        float least = 1e5F;
        std::optional<Vec3> found;
        for (int dy = -1; dy <= 1 && texel >= 0; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const int x = texel % width + dx, y = texel / width + dy;
                if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= width || y >= height)
                    continue;
                const float* stored = &image[4 * (y * width + x)];
                if (stored[3] == 0)
                    continue;
                const Vec3 there{stored[0], stored[1], stored[2]};
                const float distance = length(own - there);
                if (distance == 0 || distance >= range || (bug_ != "last_neighbour" && distance >= least))
                    continue;
                least = distance, found = there;
            }
        return found;
    }

    /// Of the particles of a texel the one with the greatest z / w, which is the nearest; of equal ones the first.
    void draw(const Matrix& matrix) {
        std::fill(image_.begin(), image_.end(), 0.0F);
        std::vector<float> depths(width * height, bug_ == "depth_not_reversed" ? 1.0F : 0.0F);
        for (const Vec3& p : positions_) {
            const Clip clip = project(matrix, p);
            const int texel = texel_of(clip, bug_ == "upside_down");
            const float depth = clip.z / clip.w;
            if (texel < 0 || !(clip.w > 0) || !(depth >= 0) || !(depth <= 1))
                continue;
            if (bug_ == "depth_not_reversed" ? depth >= depths[texel] : depth <= depths[texel])
                continue;
            depths[texel] = depth;
            const float stored[4] = {p.x, p.y, p.z, 1};
            std::copy(stored, stored + 4, &image_[4 * texel]);
        }
    }

    std::string bug_;
    std::vector<Vec3> positions_, velocities_;
    std::vector<float> collide_times_ = std::vector<float>(particles), image_ = std::vector<float>(4 * width * height);
    Matrix earlier_;
    int frame_ = 0;
};

} // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::cerr << "usage: engine FILE.h5 [BUG]\n";
        return 2;
    }
    const std::string bug = argc > 2 ? argv[2] : "";
    const std::initializer_list<std::string> bugs{"", "late_matrix", "upside_down", "last_neighbour",
                                                  "depth_not_reversed"};
    if (std::find(bugs.begin(), bugs.end(), bug) == bugs.end()) {
        std::cerr << "engine: no bug is called " << bug << '\n';
        return 2;
    }
    Engine engine(bug);
    recording::Recording recording(particles, width, height);
    engine.record(recording);
    for (int frame = 0; frame < frames; ++frame) {
        const Matrix matrix = camera(frame, frame >= 2 * frames / 3);
        const float tick = frame % 5 == 4 ? 1 / 30.0F : 1 / 60.0F;
        recording.frame(matrix.m, tick);
        engine.step(matrix, tick);
        engine.record(recording);
        recording.image(engine.image());
    }
    recording.save(argv[1], R"({
        "image": [96, 64],
        "switches": {"step": "compute", "speed_factor": 0.75},
        "clip_space": {"first_row": 1, "depth": [1, 0]},
        "constants": {"gravity": [0, -0.98, 0], "collision_range": 0.05, "collision_time": 0.05}
    })");
}
