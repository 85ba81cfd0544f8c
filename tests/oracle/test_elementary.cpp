// The elementary functions beside MPFR's, which are correctly rounded: random arguments over the whole domain and the
// hard ones (next to multiples of pi/2, to 1, to the overflow, subnormal). The largest error of each function is
// printed in units in the last place of the result; above 1 fails. The tables are computed again.
#include "lib/base/elementary_tables.h"

#include <meshtool/elementary.h>

#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <mpfr.h>
#include <random>
#include <string>
#include <vector>

namespace
{

constexpr double largest_allowed_error = 1;

std::mt19937_64 engine(20240229);
long passed = 0, failed = 0;

class Number
{
  public:
    explicit Number(mpfr_prec_t bits = 160)
    {
        mpfr_init2(value, bits);
    }
    Number(const Number &) = delete;
    Number &operator=(const Number &) = delete;
    ~Number()
    {
        mpfr_clear(value);
    }
    mpfr_t value;
};

// The distance of result from the exact value in units in the last place that a double of the exact value has. Where
// the exact value rounds to infinity or the largest double, a step across the boundary counts as one unit.
double error_in_ulps(double result, const Number &exact)
{
    if (mpfr_nan_p(exact.value) || std::isnan(result)) {
        return mpfr_nan_p(exact.value) && std::isnan(result) ? 0 : INFINITY;
    }
    double nearest = mpfr_get_d(exact.value, MPFR_RNDN);
    if (result == nearest && std::signbit(result) == std::signbit(nearest) &&
        (std::isinf(result) || mpfr_zero_p(exact.value))) {
        return 0;
    }
    if (mpfr_inf_p(exact.value) || mpfr_zero_p(exact.value) || std::signbit(result) != std::signbit(nearest)) {
        return INFINITY;
    }
    long exponent = std::max(static_cast<long>(mpfr_get_exp(exact.value)) - 53, -1074L);
    Number difference;
    if (std::isinf(result)) {
        mpfr_set_ui_2exp(difference.value, 1, 1024, MPFR_RNDN);
        mpfr_setsign(difference.value, difference.value, std::signbit(result), MPFR_RNDN);
    } else {
        mpfr_set_d(difference.value, result, MPFR_RNDN);
    }
    mpfr_sub(difference.value, difference.value, exact.value, MPFR_RNDN);
    mpfr_mul_2si(difference.value, difference.value, -exponent, MPFR_RNDN);
    return std::fabs(mpfr_get_d(difference.value, MPFR_RNDN));
}

double random_bits()
{
    for (;;) {
        uint64_t bits = engine();
        double x;
        std::memcpy(&x, &bits, sizeof x);
        if (std::isfinite(x)) {
            return x;
        }
    }
}

double between(double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(engine);
}

int below(int bound)
{
    return static_cast<int>(engine() % static_cast<uint64_t>(bound));
}

double moved(double x, int steps)
{
    for (int i = std::abs(steps); i > 0; i--) {
        x = std::nextafter(x, steps > 0 ? INFINITY : -INFINITY);
    }
    return x;
}

double near(double x)
{
    return moved(x, below(65) - 32);
}

double with_exponent(int low, int high)
{
    return std::ldexp(between(0.5, 1), low + below(high - low)) * (below(2) == 0 ? 1 : -1);
}

// k pi/2 rounded, for k up to 2^bits, and its neighbours.
double near_multiple_of_half_pi(int bits)
{
    static Number half_pi(1200);
    static bool is_set = false;
    if (!is_set) {
        mpfr_const_pi(half_pi.value, MPFR_RNDN);
        mpfr_div_ui(half_pi.value, half_pi.value, 2, MPFR_RNDN);
        is_set = true;
    }
    Number product(1300);
    double k = std::floor(std::ldexp(between(0.5, 1), 1 + below(bits)));
    mpfr_mul_d(product.value, half_pi.value, k, MPFR_RNDN);
    double x = mpfr_get_d(product.value, MPFR_RNDN);
    return moved(x, below(3) - 1) * (below(2) == 0 ? 1 : -1);
}

// The integer times a power of two that comes nearest to a multiple of pi/2, and other known hard arguments.
double hardest_angle()
{
    static const double angles[] = {6381956970095103.0 * 0x1p797,
                                    0x1.6ac5b262ca1ffp849,
                                    0x1.921fb54442d18p0,
                                    0x1.921fb54442d18p1,
                                    355,
                                    710,
                                    1e22,
                                    DBL_MAX,
                                    0x1p1023,
                                    0x1p20,
                                    0x1.fffffffffffffp19,
                                    0x1.921fb54442d18p-1,
                                    0x1.921fb54442d19p-1};
    double x = angles[below(static_cast<int>(sizeof angles / sizeof *angles))];
    return below(2) == 0 ? x : near(std::min(x, moved(DBL_MAX, -32)));
}

using Function = double (*)(double);
using Exact = int (*)(mpfr_t, const mpfr_t, mpfr_rnd_t);
using Source = std::function<double()>;

void report(const char *name, long count, double worst, const std::string &where)
{
    bool is_right = worst <= largest_allowed_error;
    is_right ? passed++ : failed++;
    std::printf("%-6s %8ld arguments, largest error %.4f ulp at %s%s\n", name, count, worst, where.c_str(),
                is_right ? "" : "   FAILED");
}

std::string text_of(double x)
{
    char text[64];
    std::snprintf(text, sizeof text, "%a", x);
    return text;
}

void test_function(const char *name, Function function, Exact exact_function, const std::vector<Source> &sources,
                   int repetitions)
{
    double worst = 0;
    std::string where = "none";
    Number argument(53), exact;
    for (const Source &source : sources) {
        for (int i = 0; i < repetitions; i++) {
            double x = source();
            mpfr_set_d(argument.value, x, MPFR_RNDN);
            exact_function(exact.value, argument.value, MPFR_RNDN);
            double error = error_in_ulps(function(x), exact);
            if (error > worst) {
                worst = error;
                where = text_of(x);
            }
        }
    }
    report(name, static_cast<long>(sources.size()) * repetitions, worst, where);
}

using Function2 = double (*)(double, double);
using Exact2 = int (*)(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);
using Source2 = std::function<std::pair<double, double>()>;

void test_function2(const char *name, Function2 function, Exact2 exact_function, const std::vector<Source2> &sources,
                    int repetitions)
{
    double worst = 0;
    std::string where = "none";
    Number a(53), b(53), exact;
    for (const Source2 &source : sources) {
        for (int i = 0; i < repetitions; i++) {
            std::pair<double, double> x = source();
            mpfr_set_d(a.value, x.first, MPFR_RNDN);
            mpfr_set_d(b.value, x.second, MPFR_RNDN);
            exact_function(exact.value, a.value, b.value, MPFR_RNDN);
            double error = error_in_ulps(function(x.first, x.second), exact);
            if (error > worst) {
                worst = error;
                where = text_of(x.first) + ", " + text_of(x.second);
            }
        }
    }
    report(name, static_cast<long>(sources.size()) * repetitions, worst, where);
}

double any_special()
{
    static const double values[] = {0.0,      -0.0,      1,    -1,       2,       -2,        3,
                                    -3,       0.5,       -0.5, DBL_MAX,  DBL_MIN, 0x1p-1074, -0x1p-1074,
                                    INFINITY, -INFINITY, NAN,  -DBL_MAX, 0x1p53};
    return values[below(static_cast<int>(sizeof values / sizeof *values))];
}

void test_functions_of_one()
{
    auto unit = [] { return between(-1, 1); };
    auto wide = [] { return with_exponent(-1073, 1024); };
    auto subnormal = [] { return with_exponent(-1073, -1021); };
    auto magnitude = [](const Source &source) { return [source] { return std::fabs(source()); }; };
    const std::vector<Source> angles = {
        [] { return between(-10, 10); },
        [] { return between(-2e6, 2e6); },
        wide,
        subnormal,
        random_bits,
        [] { return with_exponent(18, 24); },
        [] { return near_multiple_of_half_pi(20); },
        [] { return near_multiple_of_half_pi(50); },
        [] { return near_multiple_of_half_pi(1000); },
        hardest_angle,
        [] { return with_exponent(-30, 2); },
        any_special,
    };
    test_function("sin", mt_sin, mpfr_sin, angles, 60000);
    test_function("cos", mt_cos, mpfr_cos, angles, 60000);
    test_function("tan", mt_tan, mpfr_tan, angles, 60000);
    const std::vector<Source> sines = {unit,
                                       subnormal,
                                       [] { return with_exponent(-60, 1); },
                                       [] { return near(1 - std::ldexp(between(0.5, 1), -below(52))); },
                                       [] { return near(-1 + std::ldexp(between(0.5, 1), -below(52))); },
                                       [] { return near(0.5); },
                                       [] { return near(std::sqrt(0.5)); },
                                       any_special};
    test_function("asin", mt_asin, mpfr_asin, sines, 40000);
    test_function("acos", mt_acos, mpfr_acos, sines, 40000);
    test_function("atan", mt_atan, mpfr_atan,
                  {unit, wide, random_bits, [] { return with_exponent(-30, 65); }, [] { return near(1); },
                   [] { return near((below(64) + 0.5) / 64); }, any_special},
                  60000);
    test_function("exp", mt_exp, mpfr_exp,
                  {[] { return between(-745.2, 709.8); }, unit, random_bits, [] { return with_exponent(-60, 4); },
                   [] { return near(709.782712893384); }, [] { return between(-745.2, -708); },
                   [] { return near(-745.1332191019412); }, [] { return near(-708.3964185322641); },
                   [] { return near((below(128000) - 64000 + 0.5) * (M_LN2 / 64)); }, any_special},
                  50000);
    test_function("log", mt_log, mpfr_log,
                  {magnitude(random_bits), magnitude(subnormal), [] { return between(0.5, 2); }, [] { return near(1); },
                   [] { return 1 + with_exponent(-52, -3); }, [] { return near(std::sqrt(2)); },
                   [] { return near(256 / (181.5 + below(182))); },
                   [] { return near(std::ldexp(1, below(2000) - 1000)); }, any_special},
                  50000);
    test_function("cbrt", mt_cbrt, mpfr_cbrt,
                  {random_bits, subnormal, [] { return between(-8, 8); },
                   [] { return near(std::pow(1 + below(200000), 3)); },
                   [] { return near(std::ldexp(1, below(2000) - 1000)); }, any_special},
                  50000);
}

void test_functions_of_two()
{
    auto wide = [] { return with_exponent(-1073, 1024); };
    auto special = [] { return std::make_pair(any_special(), any_special()); };
    test_function2("atan2", mt_atan2, mpfr_atan2,
                   {[=] { return std::make_pair(wide(), wide()); },
                    [] { return std::make_pair(between(-1, 1), between(-1, 1)); },
                    [=] {
                        double x = wide();
                        return std::make_pair(std::ldexp(x, below(200) - 100), x * between(-1, 1));
                    },
                    [=] {
                        double x = std::ldexp(wide(), -10);
                        return std::make_pair(near(x), near(x));
                    },
                    [] { return std::make_pair(with_exponent(-1073, -1000), with_exponent(-1073, -1000)); },
                    [] { return std::make_pair(any_special(), between(-2, 2)); },
                    [] { return std::make_pair(between(-2, 2), any_special()); }, special},
                   60000);
    auto power_to = [](double logarithm) {
        double x = std::exp(between(-700, 700));
        return std::make_pair(x, logarithm / std::log(x));
    };
    test_function2("pow", mt_pow, mpfr_pow,
                   {[] { return std::make_pair(between(0, 20), between(-20, 20)); },
                    [=] { return power_to(between(-745.2, 709.8)); },
                    [=] { return power_to(709.78271289338397 + between(-1e-9, 1e-9)); },
                    [=] { return power_to(between(-745.2, -708)); },
                    [] {
                        double x = 1 + with_exponent(-52, -3);
                        return std::make_pair(x, between(-745.2, 709.8) / std::log1p(x - 1));
                    },
                    [] { return std::make_pair(near(1), with_exponent(40, 70)); },
                    [] { return std::make_pair(static_cast<double>(below(2000) - 1000), below(100) - 50.0); },
                    [] { return std::make_pair(with_exponent(-1073, 1024), below(7) - 3.0); },
                    [] { return std::make_pair(std::fabs(random_bits()), random_bits()); },
                    [] { return std::make_pair(std::fabs(with_exponent(-1073, -1021)), between(-1, 1)); },
                    [] { return std::make_pair(std::fabs(random_bits()), with_exponent(-80, 0)); },
                    [] { return std::make_pair(any_special(), between(-5, 5)); },
                    [] { return std::make_pair(between(-5, 5), any_special()); }, special},
                   60000);
}

void check_entry(const char *table, int index, double_double entry, const Number &exact)
{
    Number rest(400);
    double high = mpfr_get_d(exact.value, MPFR_RNDN);
    mpfr_sub_d(rest.value, exact.value, high, MPFR_RNDN);
    bool is_right = entry.high == high && entry.low == mpfr_get_d(rest.value, MPFR_RNDN);
    is_right ? passed++ : failed++;
    if (!is_right) {
        std::printf("table %s, entry %d is wrong\n", table, index);
    }
}

void test_tables()
{
    Number exact(400);
    for (int i = 0; i < MT_TABLE_POWER_COUNT; i++) {
        mpfr_set_d(exact.value, i / 64.0, MPFR_RNDN);
        mpfr_exp2(exact.value, exact.value, MPFR_RNDN);
        check_entry("power of two", i, mt_table_power_of_two[i], exact);
    }
    for (int i = 0; i < MT_TABLE_LOGARITHM_COUNT; i++) {
        mpfr_set_d(exact.value, (MT_TABLE_LOGARITHM_FIRST + i) / 256.0, MPFR_RNDN);
        mpfr_log(exact.value, exact.value, MPFR_RNDN);
        mpfr_neg(exact.value, exact.value, MPFR_RNDN);
        check_entry("logarithm", i, mt_table_logarithm[i], exact);
    }
    for (int i = 0; i < MT_TABLE_ARCTANGENT_COUNT; i++) {
        mpfr_set_d(exact.value, i / 64.0, MPFR_RNDN);
        mpfr_atan(exact.value, exact.value, MPFR_RNDN);
        check_entry("arc tangent", i, mt_table_arctangent[i], exact);
    }
    Number rest(2000);
    mpfr_const_pi(rest.value, MPFR_RNDN);
    mpfr_ui_div(rest.value, 2, rest.value, MPFR_RNDN);
    for (int i = 0; i < MT_TABLE_TWO_OVER_PI_COUNT; i++) {
        unsigned long word = mpfr_get_ui(rest.value, MPFR_RNDZ);
        word == mt_table_two_over_pi[i] ? passed++ : failed++;
        mpfr_sub_ui(rest.value, rest.value, word, MPFR_RNDN);
        mpfr_mul_2ui(rest.value, rest.value, 32, MPFR_RNDN);
    }
}

} // namespace

int main()
{
    test_tables();
    test_functions_of_one();
    test_functions_of_two();
    std::printf("%ld passed, %ld failed\n", passed, failed);
    return failed != 0;
}
