// The frame of the benchmarks: runs ours and a peer in turn, and keeps medians, peak memory and the error beside them.
#pragma once

#include <meshtool/meshtool.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench
{

struct Sample {
    double seconds = 0; // median
    double spread = 0;  // (maximum - minimum) / median
    // Most resident bytes above those before the run, or of a process that the run started; the largest of the runs.
    std::uint64_t peak = 0;
};

struct Row {
    std::string name, mesh, peer;
    std::uint64_t faces = 0;
    Sample ours, ours_all, theirs; // one thread, all threads, the peer
    double error = -1;             // largest difference to the peer; negative: none can be named
    std::uint64_t bytes = 0;       // of the file, when its rate is to stand in the note
    std::string note;
    const double *verdict = nullptr; // where the peer's runs leave the error; else it is given
};

// A run takes the context to work in and returns nothing; what it made it destroys.
using Ours = std::function<void(mt_context *)>;
using Theirs = std::function<void()>;

// Runs ours on one thread, ours on all and the peer's in turn, nine times or for three seconds in all, but three times
// at least; a peer that has taken three seconds does not run again.
void compare(Row row, const Ours &ours, const Theirs &theirs);

// The same, each once and with nothing unmeasured before: for what takes seconds, or is one row of very many.
void compare_once(Row row, const Ours &ours, const Theirs &theirs);

// Every case by name, and what it measures.
struct Case {
    const char *name;
    void (*run)();
};
void run_reading();
void run_writing();
void run_convert();
void run_images();
void run_connectivity();
void run_one_ring();
void run_normals();
void run_strips();
void run_check();
void run_self_intersection();
void run_subdivision();
void run_preview();
void run_preview_process();
void run_scene();
void run_visibility();
void run_rays();
void run_structures();
void run_closest();

const std::vector<Row> &rows();

// Writes bench.md, rows of about a million faces, bench-all.md, all rows, and bench-strips.md into a folder that is
// there.
void write_markdown(const std::string &folder);

// Writes the lengths of strips as a table of Markdown, if they were measured.
void write_strips(const std::string &path);

// A context with one thread for preparing inputs.
mt_context *shared_context();

// A closed, wavy torus of about `faces` triangles (or quads), f64, vertices in file order or shuffled.
mt_mesh *wavy_torus(std::uint64_t faces, bool quads, bool shuffled);

// Whether a program can be started, and what runs it without its output and notes its memory; a failure ends the bench.
bool installed(const std::string &program);
void run_quietly(const std::string &command);

// A new folder for files, which the caller removes.
std::string make_scratch_folder();

// Fails loudly: a benchmark of a failed operation measures nothing.
void require(mt_context *context, mt_status status);

// Sizes that show growth: 10^4, 10^5, 10^6 faces, and 5 * 10^6 where time allows.
inline const std::uint64_t sizes[] = {10000, 100000, 1000000};
inline const std::uint64_t large_size = 5000000;

} // namespace bench
