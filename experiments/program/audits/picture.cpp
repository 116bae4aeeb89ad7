#include "experiments/program/audits/picture.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

namespace ogc::experiments {

namespace {

using compare::Index;
using compare::Vec3;

constexpr std::size_t side = 720;       ///< of a panel [pixels]
constexpr std::size_t samples = 2;      ///< of a pixel, along each side: smooth outlines
constexpr std::size_t look_side = 128;  ///< of the small views that the direction is chosen by
constexpr double margin = 1.08;         ///< of a view around what it shows
constexpr double context = 4;           ///< of the close-up around the first intersection
constexpr double hidden_share = 0.35;   ///< of the colour of what lies behind something else

struct Shade {
  double red, green, blue;
};
// Told apart with any kind of colour vision (Okabe and Ito 2008).
constexpr Shade vermilion{213, 94, 0}, blue{0, 114, 178}, grey{200, 204, 208}, line_grey{110, 114, 118},
    frame_black{30, 30, 30}, white{255, 255, 255};

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 unit(const Vec3& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Vec3{v.x / length, v.y / length, v.z / length} : v;
}

/// A cube: what a view shows, whatever its direction.
struct Region {
  Vec3 centre;
  double half = 0;
};

struct Bounds {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Region region(double times) const {
    const Vec3 size = minus(high, low);
    return {{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2},
            times * std::max({size.x, size.y, size.z}) / 2};
  }
  bool meets(const Region& r) const {
    return low.x <= r.centre.x + r.half && high.x >= r.centre.x - r.half && low.y <= r.centre.y + r.half &&
           high.y >= r.centre.y - r.half && low.z <= r.centre.z + r.half && high.z >= r.centre.z - r.half;
  }
};

/// From where, and how a point comes to lie on the picture.
struct View {
  View(const Vec3& direction, const Region& region, std::size_t pixels)
      : forward(unit(direction)),
        right(unit(cross(forward, std::abs(forward.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, -1}))),
        up(cross(right, forward)),
        centre(region.centre),
        scale(static_cast<double>(pixels) / (2 * margin * region.half)),
        middle(static_cast<double>(pixels) / 2) {}
  /// Moves and scales so that all of the points are just in view.
  void fit(const std::vector<Vec3>& points) {
    Bounds bounds;
    for (const Vec3& p : points) bounds.add({dot(minus(p, centre), right), dot(minus(p, centre), up), 0});
    const auto [middle_of, half] = bounds.region(1);
    if (!(half > 0)) return;
    centre = {centre.x + middle_of.x * right.x + middle_of.y * up.x,
              centre.y + middle_of.x * right.y + middle_of.y * up.y,
              centre.z + middle_of.x * right.z + middle_of.y * up.z};
    scale = middle / (margin * half);
  }
  /// x to the right, y down [pixels], z away [pixels].
  Vec3 project(const Vec3& p) const {
    const Vec3 d = minus(p, centre);
    return {middle + scale * dot(d, right), middle - scale * dot(d, up), scale * dot(d, forward)};
  }
  Vec3 forward, right, up, centre;
  double scale, middle;
};

/// A square of samples with depth.
class Canvas {
 public:
  explicit Canvas(std::size_t pixels)
      : pixels_(pixels),
        depth_(pixels * pixels, std::numeric_limits<double>::infinity()),
        colour_(pixels * pixels, white) {}

  std::size_t pixels() const { return pixels_; }
  double depth(std::size_t i) const { return depth_[i]; }
  const Shade& colour(std::size_t i) const { return colour_[i]; }

  /// Calls `use(sample, depth)` for each sample that the projected triangle covers.
  template <class Use>
  void cover(const std::array<Vec3, 3>& c, Use&& use) const {
    const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    if (area == 0) return;
    const auto [x_low, x_high] = range(c[0].x, c[1].x, c[2].x);
    const auto [y_low, y_high] = range(c[0].y, c[1].y, c[2].y);
    for (std::size_t j = y_low; j < y_high; ++j)
      for (std::size_t i = x_low; i < x_high; ++i) {
        const double x = static_cast<double>(i) + 0.5, y = static_cast<double>(j) + 0.5;
        const double b = ((x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (y - c[0].y)) / area;
        const double a = ((c[1].x - c[0].x) * (y - c[0].y) - (x - c[0].x) * (c[1].y - c[0].y)) / area;
        if (b >= 0 && a >= 0 && a + b <= 1)
          use(j * pixels_ + i, c[0].z + b * (c[1].z - c[0].z) + a * (c[2].z - c[0].z));
      }
  }

  void fill(const std::array<Vec3, 3>& corners, const Shade& shade) {
    cover(corners, [&](std::size_t i, double z) {
      if (z >= depth_[i]) return;
      depth_[i] = z;
      colour_[i] = shade;
    });
  }

  /// Over what is there: in full where it is not behind by more than `slack`, otherwise with a share of `hidden`.
  void blend(std::size_t i, double z, double slack, const Shade& shade, double hidden) {
    const double share = z <= depth_[i] + slack ? 1 : hidden;
    Shade& old = colour_[i];
    old = {old.red + share * (shade.red - old.red), old.green + share * (shade.green - old.green),
           old.blue + share * (shade.blue - old.blue)};
  }

  /// A line of the given radius [pixels], or a disc where both ends are one. Each sample is blended once.
  void line(const Vec3& a, const Vec3& b, double radius, const Shade& shade, double hidden) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const auto [x_low, x_high] = range(a.x - radius, b.x - radius, std::max(a.x, b.x) + radius);
    const auto [y_low, y_high] = range(a.y - radius, b.y - radius, std::max(a.y, b.y) + radius);
    for (std::size_t j = y_low; j < y_high; ++j)
      for (std::size_t i = x_low; i < x_high; ++i) {
        const double x = static_cast<double>(i) + 0.5 - a.x, y = static_cast<double>(j) + 0.5 - a.y;
        const double t = square > 0 ? std::clamp((x * dx + y * dy) / square, 0.0, 1.0) : 0;
        if (std::hypot(x - t * dx, y - t * dy) <= radius)
          blend(j * pixels_ + i, a.z + t * (b.z - a.z), 2 * radius, shade, hidden);
      }
  }

 private:
  /// Whole samples from the smallest to the largest of three coordinates, inside the canvas.
  std::pair<std::size_t, std::size_t> range(double a, double b, double c) const {
    const double most = static_cast<double>(pixels_);
    return {static_cast<std::size_t>(std::clamp(std::floor(std::min({a, b, c})), 0.0, most)),
            static_cast<std::size_t>(std::clamp(std::ceil(std::max({a, b, c})), 0.0, most))};
  }

  std::size_t pixels_;
  std::vector<double> depth_;
  std::vector<Shade> colour_;
};

/// What is drawn: some triangles of the mesh, and which of them offend.
class Painter {
 public:
  Painter(const Offenders& offenders, const compare::Topology& topology, const std::vector<Vec3>& positions)
      : offenders_(offenders), topology_(topology), positions_(positions) {}

  const Vec3& at(Index v) const { return positions_[static_cast<std::size_t>(v)]; }
  const compare::Triangle& triangle(Index t) const { return topology_.triangles[static_cast<std::size_t>(t)]; }
  const compare::Edge& edge(Index e) const { return topology_.edges[static_cast<std::size_t>(e)]; }

  /// The region of the whole mesh.
  Region whole() const {
    Bounds bounds;
    for (const Vec3& p : positions_) bounds.add(p);
    return bounds.region(1);
  }

  /// Around the first intersection: its edge or its triangle, whichever is smaller.
  Region first() const {
    Bounds edge_bounds, triangle_bounds;
    if (offenders_.first.kind == compare::IntersectionKind::edge_edge) {
      for (const Index v : edge(offenders_.first.first)) edge_bounds.add(at(v));
      return edge_bounds.region(1);
    }
    for (const Index v : triangle(offenders_.first.second)) triangle_bounds.add(at(v));
    if (offenders_.first.kind == compare::IntersectionKind::vertex_triangle) return triangle_bounds.region(1);
    for (const Index v : edge(offenders_.first.first)) edge_bounds.add(at(v));
    const Region along_edge = edge_bounds.region(1), on_triangle = triangle_bounds.region(1);
    return along_edge.half > 0 && along_edge.half < on_triangle.half ? along_edge : on_triangle;
  }

  std::vector<Index> triangles_in(const Region& region) const {
    std::vector<Index> found;
    for (std::size_t t = 0; t < topology_.triangles.size(); ++t) {
      Bounds bounds;
      for (const Index v : topology_.triangles[t]) bounds.add(at(v));
      if (bounds.meets(region)) found.push_back(static_cast<Index>(t));
    }
    return found;
  }

  /// How many samples show an offending triangle of these with nothing before it, the more the less it is seen from the
  /// side.
  double seen(const View& view, std::span<const Index> triangles) const {
    Canvas canvas(look_side);
    for (const Index t : triangles) canvas.fill(projected(view, t), white);
    double sum = 0;
    for (const Index t : triangles) {
      if (!std::ranges::binary_search(offenders_.triangles, t)) continue;
      const double facing = std::abs(dot(normal(t), view.forward));
      canvas.cover(projected(view, t), [&](std::size_t i, double z) { sum += z <= canvas.depth(i) ? facing : 0; });
    }
    return sum;
  }

  /// `triangles`: ascending. Only the close-up has room for their edges.
  Canvas draw(const View& view, std::span<const Index> triangles, bool close_up) const {
    Canvas canvas(side * samples);
    for (const Index t : triangles) canvas.fill(projected(view, t), shaded(view, t, grey));
    for (const Index t : close_up ? triangles : std::span<const Index>()) draw_sides(canvas, view, t, line_grey);
    Canvas nearest(canvas.pixels());
    std::vector<Index> offending;
    std::ranges::set_intersection(triangles, offenders_.triangles, std::back_inserter(offending));
    for (const Index t : offending) nearest.fill(projected(view, t), shaded(view, t, vermilion));
    for (std::size_t i = 0; i < canvas.pixels() * canvas.pixels(); ++i)
      if (std::isfinite(nearest.depth(i))) canvas.blend(i, nearest.depth(i), samples, nearest.colour(i), hidden_share);
    for (const Index t : close_up ? offending : std::vector<Index>()) draw_sides(canvas, view, t, frame_black);
    for (const Index e : offenders_.edges) draw_edge(canvas, view, e, close_up ? 2 : 1, blue, hidden_share);
    for (const Index v : offenders_.vertices)
      canvas.line(view.project(at(v)), view.project(at(v)), 4.0 * samples, blue, hidden_share);
    return canvas;
  }

 private:
  std::array<Vec3, 3> projected(const View& view, Index t) const {
    const compare::Triangle& corners = triangle(t);
    return {view.project(at(corners[0])), view.project(at(corners[1])), view.project(at(corners[2]))};
  }

  Vec3 normal(Index t) const {
    const compare::Triangle& c = triangle(t);
    return unit(cross(minus(at(c[1]), at(c[0])), minus(at(c[2]), at(c[0]))));
  }

  /// Lit from the eye, the same on both sides.
  Shade shaded(const View& view, Index t, const Shade& shade) const {
    const double light = 0.6 + 0.4 * std::abs(dot(normal(t), view.forward));
    return {light * shade.red, light * shade.green, light * shade.blue};
  }

  void draw_edge(Canvas& canvas, const View& view, Index e, double radius, const Shade& shade, double hidden) const {
    canvas.line(view.project(at(edge(e)[0])), view.project(at(edge(e)[1])), radius * static_cast<double>(samples),
                shade, hidden);
  }

  void draw_sides(Canvas& canvas, const View& view, Index t, const Shade& shade) const {
    for (const Index e : topology_.triangle_edges[static_cast<std::size_t>(t)])
      draw_edge(canvas, view, e, 0.6, shade, 0);
  }

  const Offenders& offenders_;
  const compare::Topology& topology_;
  const std::vector<Vec3>& positions_;
};

/// The one of 26 directions from which most is seen. The first ones look from above and aside, as people do: others
/// must show a quarter more.
Vec3 best_direction(const Painter& painter, const Region& region, std::span<const Index> triangles) {
  Vec3 best;
  double most = 0;
  for (const double y : {-1.0, 0.0, 1.0})
    for (const double z : {-1.0, 1.0, 0.0})
      for (const double x : {-1.0, 1.0, 0.0}) {
        if (x == 0 && y == 0 && z == 0) continue;
        const double seen = painter.seen(View({x, y, z}, region, look_side), triangles);
        if (seen > 1.25 * most || dot(best, best) == 0) best = {x, y, z}, most = std::max(most, seen);
      }
  return best;
}

/// The outline of a cube, over everything.
void draw_box(Canvas& canvas, const View& view, const Region& region) {
  const auto corner = [&](int k) {
    const auto end = [&](int bit) { return (k >> bit & 1) != 0 ? region.half : -region.half; };
    return view.project({region.centre.x + end(0), region.centre.y + end(1), region.centre.z + end(2)});
  };
  for (int k = 0; k < 8; ++k)
    for (int bit = 0; bit < 3; ++bit)
      if ((k >> bit & 1) == 0) canvas.line(corner(k), corner(k | 1 << bit), 1.0 * samples, frame_black, 1);
}

void copy(const Canvas& canvas, Image& image, std::size_t left) {
  const auto rounded = [](double sum) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(sum / (samples * samples)), 0L, 255L));
  };
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t i = 0; i < side; ++i) {
      Shade sum{0, 0, 0};
      for (std::size_t k = 0; k < samples * samples; ++k) {
        const Shade& one = canvas.colour((samples * j + k / samples) * canvas.pixels() + samples * i + k % samples);
        sum = {sum.red + one.red, sum.green + one.green, sum.blue + one.blue};
      }
      image.pixels[j * image.width + left + i] = {rounded(sum.red), rounded(sum.green), rounded(sum.blue)};
    }
}

}  // namespace

Image picture_of(const Offenders& offenders, const compare::Topology& topology, const std::vector<Vec3>& positions) {
  const Painter painter(offenders, topology, positions);
  const Region whole = painter.whole();
  Region near = painter.first();
  // What has collapsed to a point has no size: then a hundredth of the whole.
  near.half = context * (near.half > 0 ? near.half : whole.half / 100);
  const std::vector<Index> all = painter.triangles_in(whole), around = painter.triangles_in(near);
  const Vec3 direction = best_direction(painter, near, around);
  constexpr std::size_t gap = 8;
  Image image{2 * side + gap, side, std::vector<Colour>((2 * side + gap) * side, {160, 160, 160})};
  View from_afar(direction, whole, side * samples);
  from_afar.fit(positions);
  Canvas left = painter.draw(from_afar, all, false);
  draw_box(left, from_afar, near);
  copy(left, image, 0);
  copy(painter.draw(View(direction, near, side * samples), around, true), image, side + gap);
  return image;
}

}  // namespace ogc::experiments
