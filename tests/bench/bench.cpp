#include "tests/bench/bench.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace bench
{
namespace
{

std::vector<Row> all_rows;
std::uint64_t child_peak = 0; // of the processes since the run began

std::uint64_t status_bytes(const char *key)
{
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        if (word == key) {
            std::uint64_t kilobytes = 0;
            status >> kilobytes;
            return kilobytes * 1024;
        }
    }
    return 0;
}

struct Series {
    std::vector<double> seconds;
    std::uint64_t peak = 0;
    double total = 0;

    void run(const Theirs &work)
    {
        malloc_trim(0);
        std::ofstream("/proc/self/clear_refs") << "5"; // the high-water mark falls to what is resident now
        std::uint64_t before = status_bytes("VmRSS:");
        child_peak = 0;
        auto begin = std::chrono::steady_clock::now();
        work();
        auto end = std::chrono::steady_clock::now();
        std::uint64_t high = status_bytes("VmHWM:");
        seconds.push_back(std::chrono::duration<double>(end - begin).count());
        total += seconds.back();
        peak = std::max({peak, high > before ? high - before : 0, child_peak});
    }

    Sample sample()
    {
        std::sort(seconds.begin(), seconds.end());
        double median = seconds[seconds.size() / 2];
        return {median, (seconds.back() - seconds.front()) / median, peak};
    }
};

void print_time(double seconds)
{
    std::printf(seconds < 0.01 ? "%9.3f" : "%9.1f", seconds * 1e3);
}

void print_row(const Row &row)
{
    std::printf("%-22s %-14s %8llu ", row.name.c_str(), row.mesh.c_str(), static_cast<unsigned long long>(row.faces));
    print_time(row.ours.seconds);
    print_time(row.ours_all.seconds);
    print_time(row.theirs.seconds);
    std::printf("  %-9s %6.1fx %6.1fx %8.1f %8.1f ", row.peer.c_str(), row.theirs.seconds / row.ours.seconds,
                row.theirs.seconds / row.ours_all.seconds, static_cast<double>(row.ours.peak) / 1e6,
                static_cast<double>(row.theirs.peak) / 1e6);
    if (row.error >= 0) {
        std::printf("%9.2g", row.error);
    } else {
        std::printf("%9s", "-");
    }
    std::printf("  %s\n", row.note.c_str());
    std::fflush(stdout);
}

void print_head()
{
    std::printf("%-22s %-14s %8s %9s%9s%9s  %-9s %7s %7s %8s %8s %9s\n", "case", "mesh", "faces", "ours 1t", "ours all",
                "peer ms", "peer", "ratio1", "ratio", "MB ours", "MB peer", "error");
}

// Names and notes may have commas in them.
std::string quoted(const std::string &text)
{
    std::string result = "\"";
    for (char c : text) {
        result += c == '"' ? "\"\"" : std::string(1, c);
    }
    return result + '"';
}

void write_csv(const char *path)
{
    std::ofstream csv(path);
    csv << "case,mesh,faces,peer,ours_1_thread_s,ours_all_threads_s,peer_s,ours_spread,peer_spread,"
           "ours_peak_bytes,peer_peak_bytes,error,note\n";
    for (const Row &row : all_rows) {
        csv << quoted(row.name) << ',' << quoted(row.mesh) << ',' << row.faces << ',' << quoted(row.peer) << ','
            << row.ours.seconds << ',' << row.ours_all.seconds << ',' << row.theirs.seconds << ',' << row.ours.spread
            << ',' << row.theirs.spread << ',' << row.ours.peak << ',' << row.theirs.peak << ',';
        if (row.error >= 0) {
            csv << row.error;
        }
        csv << ',' << quoted(row.note) << '\n';
    }
}

// "39 MB, 350 MB/s a thread, x1.8 on all" before what the note says.
std::string rate_note(const Row &row)
{
    char text[96];
    double megabytes = static_cast<double>(row.bytes) / 1e6;
    std::snprintf(text, sizeof text, "%.0f MB, %.0f MB/s a thread, x%.2f on all%s", megabytes,
                  megabytes / row.ours.seconds, row.ours.seconds / row.ours_all.seconds, row.note.empty() ? "" : "; ");
    return text + row.note;
}

const Case cases[] = {
    {"reading", run_reading},
    {"writing", run_writing},
    {"convert", run_convert},
    {"connectivity", run_connectivity},
    {"one-ring", run_one_ring},
    {"normals", run_normals},
    {"strips", run_strips},
    {"check", run_check},
    {"self-intersection", run_self_intersection},
    {"subdivision", run_subdivision},
    {"images", run_images},
    {"preview", run_preview},
    {"preview-process", run_preview_process},
    {"visibility", run_visibility},
    {"rays", run_rays},
    {"structures", run_structures},
    {"closest", run_closest},
    {"scene", run_scene},
};

int run_cases(int count, char **names)
{
    print_head();
    for (const Case &one : cases) {
        bool wanted = count == 0;
        for (int i = 0; i < count; i++) {
            wanted = wanted || std::strcmp(names[i], one.name) == 0;
        }
        if (wanted) {
            one.run();
        }
    }
    return all_rows.empty() ? 2 : 0;
}

} // namespace

const std::vector<Row> &rows()
{
    return all_rows;
}

bool installed(const std::string &program)
{
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

void run_quietly(const std::string &command)
{
    std::string line = command + " >/dev/null 2>&1";
    pid_t process = fork();
    if (process == 0) {
        execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char *>(nullptr));
        _exit(127);
    }
    int status = -1;
    struct rusage usage {
    };
    if (process < 0 || wait4(process, &status, 0, &usage) != process || status != 0) {
        std::fprintf(stderr, "bench: failed: %s\n", command.c_str());
        std::exit(1);
    }
    child_peak = std::max(child_peak, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024);
}

std::string make_scratch_folder()
{
    std::string folder = (std::filesystem::temp_directory_path() / "meshtool-bench-XXXXXX").string();
    if (!mkdtemp(folder.data())) {
        std::perror("bench: mkdtemp");
        std::exit(1);
    }
    return folder;
}

void require(mt_context *context, mt_status status)
{
    if (status != MT_OK) {
        std::fprintf(stderr, "bench: %s\n", mt_context_error(context)->message);
        std::exit(1);
    }
}

mt_context *shared_context()
{
    static mt_context *context = [] {
        mt_context_options options{};
        options.thread_count = 1;
        return mt_context_create(&options);
    }();
    return context;
}

namespace
{

// A context of one thread and one of all, and the three series that a row is made of.
struct Comparison {
    mt_context *single, *all;
    Series ours_single, ours_all, peer;

    Comparison()
    {
        mt_context_options one_thread{};
        one_thread.thread_count = 1;
        single = mt_context_create(&one_thread);
        all = mt_context_create(nullptr);
    }
    ~Comparison()
    {
        mt_context_destroy(single);
        mt_context_destroy(all);
    }
    Comparison(const Comparison &) = delete;
    Comparison &operator=(const Comparison &) = delete;

    void keep(Row row)
    {
        row.ours = ours_single.sample();
        row.ours_all = ours_all.sample();
        row.theirs = peer.sample();
        if (row.verdict) {
            row.error = *row.verdict;
            row.verdict = nullptr;
        }
        if (row.bytes) {
            row.note = rate_note(row);
        }
        print_row(row);
        all_rows.push_back(row);
    }
};

} // namespace

void compare(Row row, const Ours &ours, const Theirs &theirs)
{
    Comparison runs;
    ours(runs.single); // once unmeasured: the first run pays for page tables and caches
    for (int i = 0; i < 9 && (i < 3 || runs.ours_single.total + runs.ours_all.total + runs.peer.total < 3.0); i++) {
        runs.ours_single.run([&] { ours(runs.single); });
        if (runs.ours_single.seconds.back() < 0.25) {
            ours(
                runs.all); // unmeasured: a CPU that slept while one thread ran alone takes tens of milliseconds to wake
        }
        runs.ours_all.run([&] { ours(runs.all); });
        if (runs.peer.total < 3.0) {
            runs.peer.run(theirs);
        }
    }
    runs.keep(row);
}

void compare_once(Row row, const Ours &ours, const Theirs &theirs)
{
    Comparison runs;
    runs.ours_single.run([&] { ours(runs.single); });
    runs.ours_all.run([&] { ours(runs.all); });
    runs.peer.run(theirs);
    runs.keep(row);
}

} // namespace bench

int main(int argc, char **argv)
{
    const char *csv = nullptr;
    int first = 1;
    if (argc > 2 && std::strcmp(argv[1], "--csv") == 0) {
        csv = argv[2];
        first = 3;
    }
    int result = bench::run_cases(argc - first, argv + first);
    if (result == 2) {
        std::fputs("bench: no such case; there are:", stderr);
        for (const bench::Case &one : bench::cases) {
            std::fprintf(stderr, " %s", one.name);
        }
        std::fputs("\n", stderr);
    }
    if (csv) {
        std::string path = csv;
        bench::write_csv(csv);
        bench::write_markdown(path.find('/') == std::string::npos ? "." : path.substr(0, path.rfind('/')));
    }
    return result;
}
