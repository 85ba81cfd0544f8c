// The predicates beside GMP's rationals, which are exact: random, nearly degenerate, exactly degenerate and
// extreme coordinates. Every sign must agree, with the filter and without.
#include <meshtool/predicates.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gmp.h>
#include <random>
#include <vector>

namespace
{

// An exact rational; only what determinants need.
class Rational
{
  public:
    Rational()
    {
        mpq_init(value);
    }
    explicit Rational(double x)
    {
        mpq_init(value);
        mpq_set_d(value, x);
    }
    Rational(const Rational &other)
    {
        mpq_init(value);
        mpq_set(value, other.value);
    }
    Rational &operator=(const Rational &other)
    {
        mpq_set(value, other.value);
        return *this;
    }
    ~Rational()
    {
        mpq_clear(value);
    }
    Rational operator-(const Rational &other) const
    {
        Rational result;
        mpq_sub(result.value, value, other.value);
        return result;
    }
    Rational operator+(const Rational &other) const
    {
        Rational result;
        mpq_add(result.value, value, other.value);
        return result;
    }
    Rational operator*(const Rational &other) const
    {
        Rational result;
        mpq_mul(result.value, value, other.value);
        return result;
    }
    int sign() const
    {
        return mpq_sgn(value);
    }

  private:
    mpq_t value;
};

using Point = std::array<double, 3>;
using Points = std::array<Point, 4>;

int rational_turn(const Points &p, int x, int y)
{
    Rational cx(p[2][x]), cy(p[2][y]);
    Rational left = (Rational(p[0][x]) - cx) * (Rational(p[1][y]) - cy);
    Rational right = (Rational(p[0][y]) - cy) * (Rational(p[1][x]) - cx);
    return (left - right).sign();
}

int rational_side(const Points &p)
{
    std::array<std::array<Rational, 3>, 3> m;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m[i][j] = Rational(p[i][j]) - Rational(p[3][j]);
        }
    }
    Rational sum(0.0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum = sum + m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
    }
    return sum.sign();
}

mt_vec3 vector_of(const Point &p)
{
    return mt_vec3_make(p[0], p[1], p[2]);
}

struct Count {
    long passed = 0, failed = 0;
    std::array<long, 3> signs{};

    void check(bool right, const char *what, const char *kind, const Points &p)
    {
        right ? passed++ : failed++;
        if (!right && failed < 10) {
            std::printf("%s is wrong on %s:", what, kind);
            for (const Point &point : p) {
                std::printf(" (%a, %a, %a)", point[0], point[1], point[2]);
            }
            std::printf("\n");
        }
    }
};

void check_points(const Points &p, const char *kind, Count &count)
{
    int side = rational_side(p);
    count.signs[side + 1]++;
    std::array<mt_vec3, 4> v;
    for (int i = 0; i < 4; i++) {
        v[i] = vector_of(p[i]);
    }
    count.check(mt_orient3d(v[0], v[1], v[2], v[3]) == side, "mt_orient3d", kind, p);
    count.check(mt_orient3d_exact(v[0], v[1], v[2], v[3]) == side, "mt_orient3d_exact", kind, p);
    int turns[3];
    for (int i = 0; i < 3; i++) {
        int x = i, y = (i + 1) % 3;
        turns[i] = rational_turn(p, x, y);
        const double a[2] = {p[0][x], p[0][y]}, b[2] = {p[1][x], p[1][y]}, c[2] = {p[2][x], p[2][y]};
        count.check(mt_orient2d(a, b, c) == turns[i], "mt_orient2d", kind, p);
        count.check(mt_orient2d_exact(a, b, c) == turns[i], "mt_orient2d_exact", kind, p);
    }
    bool collinear = turns[0] == 0 && turns[1] == 0 && turns[2] == 0;
    count.check(mt_collinear(v[0], v[1], v[2]) == collinear, "mt_collinear", kind, p);
}

std::mt19937_64 engine(20240229);

double uniform()
{
    return static_cast<double>(static_cast<int64_t>(engine())) * 0x1p-63;
}

int below(int bound)
{
    return static_cast<int>(engine() % static_cast<uint64_t>(bound));
}

Point scaled_sum(const Point &a, double s, const Point &b, double t)
{
    return {a[0] * s + b[0] * t, a[1] * s + b[1] * t, a[2] * s + b[2] * t};
}

Points fill(const std::function<double()> &coordinate)
{
    Points p;
    for (Point &point : p) {
        for (double &x : point) {
            x = coordinate();
        }
    }
    return p;
}

// Points on one plane or line up to rounding, some moved by a step of the last place.
Points nearly_degenerate()
{
    Points p = fill(uniform);
    if (below(3) == 0) {
        p[2] = scaled_sum(p[0], 0.5 + uniform(), p[1], 0.5 - uniform());
    }
    double s = uniform(), t = uniform();
    Point edge = scaled_sum(p[1], s, p[2], t);
    p[3] = scaled_sum(p[0], 1 - s - t, edge, 1);
    if (below(2) == 0) {
        double &x = p[below(4)][below(3)];
        x = std::nextafter(x, uniform() * 10);
    }
    return p;
}

// Small integers times a power of two: about half of the determinants vanish exactly.
Points grid()
{
    int exponent = below(2000) - 1000, width = 2 + below(4);
    return fill([=] { return std::ldexp(below(width), exponent); });
}

// Integer combinations of integers: exactly on a plane through the first three, or on their line.
Points exactly_degenerate()
{
    int exponent = below(1900) - 950;
    Points p = fill([] { return static_cast<double>(below(1 << 20) - (1 << 19)); });
    bool line = below(2) == 0;
    double s = below(64) - 32, t = line ? 0 : below(64) - 32;
    for (int i = 0; i < 3; i++) {
        p[3][i] = p[0][i] + s * (p[1][i] - p[0][i]) + t * (p[2][i] - p[0][i]);
    }
    if (line) {
        std::swap(p[2], p[3]);
    }
    for (Point &point : p) {
        for (double &x : point) {
            x = std::ldexp(x, exponent);
        }
    }
    return p;
}

double any_exponent()
{
    return std::ldexp(uniform(), below(2120) - 1100);
}

double mixed_end()
{
    static const double ends[] = {0, 0x1p-1074, 0x3p-1074, 0x1p-1022, 1e-300, 1, 1e300, 0x1p1023, DBL_MAX};
    double x = ends[below(9)] * (below(2) == 0 ? 1 : -1);
    return below(4) == 0 ? std::nextafter(x, 0) : x;
}

double tiny()
{
    return std::ldexp(below(9) - 4, -1074);
}

double near_underflow()
{
    return std::ldexp(uniform(), -330 - below(230));
}

double near_overflow()
{
    return std::ldexp(uniform(), 1023 - below(3) * 340);
}

} // namespace

int main()
{
    struct Kind {
        const char *name;
        std::function<Points()> make;
        int repetitions;
    };
    const std::vector<Kind> kinds = {
        {"random points", [] { return fill(uniform); }, 20000},
        {"nearly degenerate points", nearly_degenerate, 100000},
        {"grid points", grid, 50000},
        {"exactly degenerate points", exactly_degenerate, 50000},
        {"points of any exponent", [] { return fill(any_exponent); }, 20000},
        {"points at the ends of the range", [] { return fill(mixed_end); }, 20000},
        {"the smallest subnormals", [] { return fill(tiny); }, 20000},
        {"products around the underflow", [] { return fill(near_underflow); }, 20000},
        {"products around the overflow", [] { return fill(near_overflow); }, 20000},
    };
    Count total;
    for (const Kind &kind : kinds) {
        Count count;
        for (int i = 0; i < kind.repetitions; i++) {
            check_points(kind.make(), kind.name, count);
        }
        std::printf("%s: %ld below, %ld on, %ld above; %ld wrong\n", kind.name, count.signs[2], count.signs[1],
                    count.signs[0], count.failed);
        total.passed += count.passed;
        total.failed += count.failed;
    }
    std::printf("%ld passed, %ld failed\n", total.passed, total.failed);
    return total.failed != 0;
}
