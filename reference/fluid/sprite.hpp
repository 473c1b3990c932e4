#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "reference/fluid/depth_code.hpp"
#include "reference/fluid/point_coord.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/readings/mistake.hpp"
#include "reference/readings/unspecified.hpp"
#include "reference/system/item_reads.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/pixel_boxes.hpp"
#include "reference/system/tile_rows.hpp"

namespace lockstep::fluid {

/// The spheres of a pass: flat or met by rays, and how large, m.
struct Spheres {
    Sphere shape = Sphere::flat;
    float radius = 0.0F;
};

/// Of each particle the pixels that its sphere may cover, and those so many pixels beside them: what lies outside is
/// not tried.
BoxesByTile sprite_boxes(const Host& host, const SystemView& state, const Spheres& spheres, double beside = 0.0);

/// The same with room for mistakes that move spheres a little, made when they are first asked for, by one state.
class BoxesAround {
  public:
    const BoxesByTile& of(const Host& host, const SystemView& state, const Spheres& spheres);

  private:
    static constexpr double room = 1.5; ///< pixels

    std::once_flag made_;
    BoxesByTile boxes_;
};

/// Which spheres a pixel is tried with.
enum class Tried { in_their_boxes, around_them, everywhere };

/// Everywhere where mistakes may take spheres out of their boxes, and they are few enough; of many around them.
Tried tried_with(std::span<const Mistake> made, std::size_t spheres);

/// A twin of spheres as a host that makes mistakes hands it its inputs.
template <class Twin> struct HandedSpheres {
    const Twin& twin;
    std::span<const Mistake> made;

    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        return twin.at_pixel(r, in, item, tried_with(made, in.before[particle_buffer].count()));
    }
};

/// Calls `visit` with the number of each sphere that a pixel is tried with.
template <class Twin, class Visit>
void for_each_tried(const Twin& twin, const SystemView& state, const Pixel& pixel, Tried tried, const Visit& visit) {
    if (tried == Tried::everywhere) {
        for (std::uint32_t i = 0; i < state[particle_buffer].count(); ++i)
            visit(i);
        return;
    }
    const BoxesByTile& boxes =
        tried == Tried::in_their_boxes ? twin.boxes : twin.around->of(*twin.host, state, twin.spheres());
    for (const std::uint32_t i : boxes.near(pixel))
        if (pixel.is_in(boxes.box(i)))
            visit(i);
}

/// A particle before the camera.
template <class R> struct Ball {
    typename R::Vec3 centre; ///< in view space
    typename R::Real w;      ///< -z
    // Of a flat one, pixels:
    typename R::Real x{}, y{}; ///< its middle
    typename R::Real half{};   ///< of its side
    bool in_doubt = false;     ///< the driver may draw it or not
};

/// A particle as a sprite, at pixels. Twin of shaders/fluid/sprite.glsl.
template <class R> class SpriteTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    SpriteTwin(R& r, const Host& host, const SystemView& state, const Spheres& spheres)
        : r_(r), host_(host), state_(state), spheres_(spheres) {}

    [[nodiscard]] Real radius() const { return r_.uniform(site::radius, spheres_.radius); }

    /// Nothing of one that is not drawn: it is no number, or too near, or a point that the driver drops.
    [[nodiscard]] std::optional<Ball<R>> ball(std::uint32_t particle) const {
        const glm::vec3 p(state_.vec4(field::position, particle));
        if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
            return {};
        const glm::mat4 to_view =
            r_.setting(site::view_moves, true) ? host_.view() : glm::mat4(glm::mat3(host_.view()));
        const auto view = r_.transform(site::centre, r_.uniform(site::view, to_view), r_.read(site::before, p));
        Ball<R> ball{r_.note(site::centre, Vec3{view.x, view.y, view.z}), {}};
        ball.w = r_.note(site::w, -ball.centre.z);
        const bool is_ray = spheres_.shape == Sphere::ray;
        const Real near = r_.uniform(site::near, host_.near_plane());
        if (!r_.decide(site::beyond_near, ball.w > (is_ray ? radius() + near : near)))
            return {};
        if (host_.switches().sprite == Sprite::points && !is_in_volume(ball)) {
            if (!has_sets || host_.points().outside != PointsOutside::open)
                return {};
            ball.in_doubt = true;
        }
        if (!is_ray)
            place(ball);
        return ball;
    }

    /// The squared distance of a pixel's centre from the sprite's middle; above 1 it is not covered.
    template <class Place> [[nodiscard]] Real squared(const Ball<R>& ball, const Place& pixel) const {
        const Real nx = from_middle_x(ball, pixel.x), ny = from_middle_y(ball, pixel.y);
        return squared_of(nx * nx, ny * ny);
    }
    [[nodiscard]] Real squared_of(const Real& along_x, const Real& along_y) const {
        return r_.note(site::magnitude, along_x + along_y);
    }
    /// How far the centre of a column's or of a row's pixels is from the middle, of half the sprite's side.
    [[nodiscard]] Real from_middle_x(const Ball<R>& ball, const IndexOf<R>& x) const {
        return from_middle(site::nx, r_.note(site::pixel_x, r_.real(x) + Real(0.5F)), ball.x, ball);
    }
    [[nodiscard]] Real from_middle_y(const Ball<R>& ball, const IndexOf<R>& y) const {
        return from_middle(site::ny, r_.note(site::pixel_y, r_.real(y) + Real(0.5F)), ball.y, ball);
    }
    /// Whether nothing is added for it is off the disc. Where that is open it is not: the height there may be 0, and
    /// what is added with it, so that no decision is needed.
    [[nodiscard]] auto is_off(const Real& squared) const {
        const auto off = squared > Real(1.0F);
        if constexpr (has_sets)
            if (const auto [yes, no] = r_.ways(off); yes && no && !item_twin::set_of(squared).any)
                return false;
        return decided(r_, site::off_disc, off);
    }
    /// The same, or off the disc, of a sphere that may not be drawn.
    [[nodiscard]] Real squared_if_drawn(const Ball<R>& ball, const Real& squared) const {
        if constexpr (has_sets)
            if (ball.in_doubt)
                return r_.unspecified(site::magnitude, Real(HUGE_VALF),
                                      static_cast<float>(item_twin::set_of(squared).low), HUGE_VALF);
        return squared;
    }
    /// What a sphere adds, or nothing, of one that may not be drawn.
    [[nodiscard]] Real addend_if_drawn(const Ball<R>& ball, const Real& addend) const {
        if constexpr (has_sets)
            if (const Interval set = item_twin::set_of(addend); ball.in_doubt && !set.any)
                return r_.unspecified(site::addend, Real(0.0F), 0.0F, static_cast<float>(set.high));
        return addend;
    }
    /// Of its centre.
    [[nodiscard]] Real window_depth(const Ball<R>& ball) const { return DepthCode<R>(r_, host_).window(ball.centre.z); }
    /// How far the surface is before the middle, of the radius. Of pixels that are not covered 0.
    [[nodiscard]] Real height(const Real& squared) const {
        return r_.note(site::nz, r_.sqrt(site::nz, r_.max(Real(0.0F), Real(1.0F) - squared)));
    }

  private:
    static constexpr bool has_sets = requires(const Real& x) { x.legal(); };

    /// A point is drawn whole or not at all, by where its middle lies (GL 4.5, 13.5).
    [[nodiscard]] bool is_in_volume(const Ball<R>& ball) const {
        const auto clip = [&](At scale_at, const Real& along, float unit) {
            return r_.abs(r_.uniform(scale_at, unit) * along);
        };
        const glm::vec2 depth = host_.depth_coefficients();
        const Real x = clip(site::p00, ball.centre.x, host_.projection()[0][0]),
                   y = clip(site::p11, ball.centre.y, host_.projection()[1][1]),
                   z = r_.abs(r_.note(site::clip_z, Real(depth.x) * ball.centre.z + Real(depth.y)));
        if (host_.points().outside == PointsOutside::drawn_beside)
            return r_.decide(site::middle_in_volume, z <= ball.w);
        return r_.decide(site::middle_in_volume, x <= ball.w && y <= ball.w && z <= ball.w);
    }
    void place(Ball<R>& ball) const {
        const Settings& s = host_.settings();
        const bool by_w = r_.setting(site::sized_by_w, host_.switches().point_size == PointSize::clip_w);
        const Real away = by_w ? ball.w : r_.note(site::distance, r_.length(site::distance, ball.centre));
        const Real scale = r_.note(site::sprite_scale, r_.uniform(site::point_scale, host_.point_scale()) * radius());
        const Real size = r_.note(site::size, r_.divide(site::size, scale, away));
        ball.half = r_.note(site::half, Real(0.5F) * drawn_size(size));
        const auto window = [&](At at, At place_at, At scale_at, At size_at, const Real& along, float unit,
                                int pixels) {
            const Real clip = r_.uniform(scale_at, unit) * along;
            const Real place = r_.note(place_at, r_.divide(place_at, clip, ball.w));
            return r_.note(at, (place + Real(1.0F)) * Real(0.5F) * r_.uniform(size_at, static_cast<float>(pixels)));
        };
        ball.x = window(site::window_x, site::place_x, site::p00, site::width, ball.centre.x, host_.projection()[0][0],
                        s.width);
        ball.y = window(site::window_y, site::place_y, site::p11, site::height, ball.centre.y, host_.projection()[1][1],
                        s.height);
    }
    /// What a driver makes of a sprite's size.
    [[nodiscard]] Real drawn_size(const Real& size) const {
        if (host_.switches().sprite != Sprite::points)
            return size;
        const auto [smallest, largest] = host_.points().sizes;
        return r_.note(site::drawn_size, r_.max(r_.min(size, Real(largest)), Real(smallest)));
    }
    [[nodiscard]] Real from_middle(At at, const Real& centre, const Real& middle, const Ball<R>& ball) const {
        const Real from = r_.divide(at, centre - middle, ball.half);
        const bool is_point = host_.switches().sprite == Sprite::points;
        return r_.note(at, is_point ? point_coordinate(at, from, {centre, middle, ball.half}) : from);
    }
    struct Along {
        Real pixel, middle, half;
    };
    /// What a driver may make of it (point_coord.hpp).
    [[nodiscard]] Real point_coordinate(At at, const Real& from, const Along& of) const {
        if constexpr (has_sets) {
            const PointSpan span{item_twin::set_of(of.pixel), item_twin::set_of(of.middle), item_twin::set_of(of.half)};
            if (span.middle.any || span.half.any || !(span.half.low > 0.0))
                return from;
            return unspecified_within(r_, at, from, point_place(host_.points().coord, span));
        } else {
            return from;
        }
    }

    R& r_;
    const Host& host_;
    const SystemView& state_;
    Spheres spheres_;
};

/// The balls of one state in one arithmetic, made when they are first asked for, by all threads that ask.
class DrawnBalls {
  public:
    /// Of a ball: its centre in view space, that one's window depth, its middle, and half its side.
    struct Numbers {
        float x, y, z, window, middle_x, middle_y, half;
    };
    explicit DrawnBalls(std::size_t count) : all_(count) {}

    template <class A> const std::vector<std::optional<Numbers>>& of(const A& arithmetic, const Host& host,
                                                                     const SystemView& state, const Spheres& spheres) {
        Values<A> r(arithmetic);
        const SpriteTwin<Values<A>> sprite(r, host, state, spheres);
        for (std::size_t first = next_.fetch_add(block); first < all_.size(); first = next_.fetch_add(block)) {
            const std::size_t last = std::min(first + block, all_.size());
            for (std::size_t i = first; i < last; ++i)
                make(sprite, i);
            made_.fetch_add(last - first);
            made_.notify_all();
        }
        for (std::size_t made = made_.load(); made < all_.size(); made = made_.load())
            made_.wait(made);
        return all_;
    }

  private:
    static constexpr std::size_t block = 1024;

    template <class Sprite> void make(const Sprite& sprite, std::size_t i) {
        const auto number = [](const auto& x) { return static_cast<float>(x); };
        if (const auto ball = sprite.ball(static_cast<std::uint32_t>(i)))
            all_[i] = {number(ball->centre.x), number(ball->centre.y),
                       number(ball->centre.z), number(sprite.window_depth(*ball)),
                       number(ball->x),        number(ball->y),
                       number(ball->half)};
    }

    std::vector<std::optional<Numbers>> all_;
    std::atomic<std::size_t> next_ = 0, made_ = 0;
};

/// What a pass asks where a sphere meets a pixel: functions, as not every sphere and not every pass asks for all.
template <class Place, class Squared, class Window, class Scene> struct Meeting {
    Meeting(Place place_, Squared squared_, Window window_, Scene scene_)
        : place(place_), squared(squared_), window(window_), scene(scene_) {}
    Place place;     ///< the pixel
    Squared squared; ///< SpriteTwin::squared there
    Window window;   ///< the window depth of the sphere's middle
    Scene scene;     ///< scene_depth there
};

/// A sphere and one pixel.
template <class R> auto meeting(R& r, const Host& host, const PassInput& in, const SpriteTwin<R>& sprite,
                                const Ball<R>& ball, std::size_t item) {
    const Pixel pixel = Pixel::of(host.settings().width, item);
    return Meeting([pixel] { return pixel; }, [&sprite, &ball, pixel] { return sprite.squared(ball, pixel); },
                   [&sprite, &ball] { return sprite.window_depth(ball); },
                   [&r, &in, item] { return item_real(r, site::scene_depth_in, in.before, field::scene_depth, item); });
}

/// The condition under which `scene_depth()` lets what lies at a window depth be seen.
template <class R, class Scene>
auto before_scene(R& r, const Host& host, const Scene& scene_depth, const typename R::Real& window) {
    using Real = typename R::Real;
    const bool tests = r.setting(site::tests_scene, host.switches().scene_depth == SceneDepth::test);
    return window < (tests ? scene_depth() : Real(HUGE_VALF));
}

} // namespace lockstep::fluid
