// The rows as tables of Markdown, for README: those in sight, and all; and strips, whose length counts.
#include "tests/bench/bench.hpp"

#include <fstream>
#include <iomanip>
#include <sstream>

namespace bench
{
namespace
{

// In sight stand meshes of about a million faces, whose cost people can compare, in the order of the file.
bool is_in_sight(const Row &row)
{
    constexpr std::uint64_t least = 900'000, most = 2'100'000;
    bool is_yardstick = row.peer == "memcpy" || row.name.find("shuffled") != std::string::npos;
    return row.faces >= least && row.faces <= most && !is_yardstick;
}

std::string with_commas(std::uint64_t number)
{
    std::string digits = std::to_string(number);
    for (std::size_t i = digits.size(); i > 3; i -= 3) {
        digits.insert(i - 3, ",");
    }
    return digits;
}

std::string rounded(double number, int digits)
{
    std::ostringstream text;
    text << std::setprecision(digits) << number;
    return text.str();
}

std::string milliseconds(double seconds)
{
    double value = seconds * 1e3;
    return value < 100 ? rounded(value, 3) : std::to_string(static_cast<long>(value + 0.5));
}

std::string fixed(double number)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << number;
    return text.str();
}

void write_row(std::ostream &out, const Row &row)
{
    out << "| " << row.name << " | " << with_commas(row.faces) << " | " << milliseconds(row.ours.seconds) << " | "
        << milliseconds(row.ours_all.seconds) << " | " << row.peer << " | " << milliseconds(row.theirs.seconds) << " | "
        << fixed(row.theirs.seconds / row.ours.seconds) << " | " << fixed(row.theirs.seconds / row.ours_all.seconds)
        << " | " << fixed(static_cast<double>(row.ours.peak) / 1e6) << " | "
        << fixed(static_cast<double>(row.theirs.peak) / 1e6) << " | " << (row.error >= 0 ? rounded(row.error, 2) : "-")
        << " |\n";
}

void write_table(const std::string &path, bool all)
{
    std::ofstream out(path);
    out << "| case | faces | ours, 1 thread | 2 threads | peer | peer | times faster, 1 thread | 2 threads | MB ours | "
           "MB peer | largest error |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Row &row : rows()) {
        if (all || is_in_sight(row)) {
            write_row(out, row);
        }
    }
}

} // namespace

void write_markdown(const std::string &folder)
{
    write_table(folder + "/bench.md", false);
    write_table(folder + "/bench-all.md", true);
    write_strips(folder + "/bench-strips.md");
}

} // namespace bench
