// Whole processes from a binary PLY to a PNG of 1024 x 1024: ours, f3d on an X server without a screen that is started
// before, and POV-Ray on the same triangles (with a shadow, its scene written before). Peers that are not installed are
// left out, and said to be.
#include "tests/bench/bench.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace bench
{
namespace
{

constexpr std::uint64_t face_count = 1000000;
const char *const display = ":97";

// An X server for the time of its life.
class Screen
{
  public:
    Screen() : process(fork())
    {
        if (process == 0) {
            std::freopen("/dev/null", "w", stderr);
            execlp("Xvfb", "Xvfb", display, "-screen", "0", "1280x1024x24", static_cast<char *>(nullptr));
            _exit(127);
        }
        std::this_thread::sleep_for(std::chrono::seconds(2));
    }
    Screen(const Screen &) = delete;
    Screen &operator=(const Screen &) = delete;
    ~Screen()
    {
        kill(process, SIGTERM);
        waitpid(process, nullptr, 0);
    }

  private:
    pid_t process;
};

void write_scene(const mt_mesh *mesh, const std::string &path)
{
    std::ofstream out(path);
    out << "camera { location <0, 2.4, -3.4> look_at <0, 0, 0> angle 40 }\n"
           "light_source { <-3, 5, -4> rgb 1 }\nbackground { rgb 0.9 }\nmesh2 {\nvertex_vectors { "
        << mesh->vertex_count;
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        mt_vec3 p = mt_mesh_position(mesh, i);
        out << ",\n<" << p.x << ',' << p.y << ',' << p.z << '>';
    }
    out << " }\nface_indices { " << mesh->face_count;
    for (mt_index i = 0; i < mesh->face_count; i++) {
        const mt_index *c = mesh->corner_vertices + 3 * i;
        out << ",\n<" << c[0] << ',' << c[1] << ',' << c[2] << '>';
    }
    out << " }\npigment { rgb 0.8 } }\n";
}

void beside(const char *peer, const std::string &folder, const std::string &theirs)
{
    Row row;
    row.name = "preview, whole process";
    row.mesh = "torus";
    row.faces = face_count;
    row.peer = peer;
    row.note = "binary PLY to PNG, 1024 x 1024";
    std::string ours = std::string(MESHTOOL_BINARY) + " preview " + folder + "/mesh.ply -o " + folder + "/ours.png";
    compare(
        row,
        [&](mt_context *context) {
            run_quietly(ours + " --threads " + std::to_string(mt_context_thread_count(context)));
        },
        [&] { run_quietly(theirs); });
}

} // namespace

void run_preview_process()
{
    std::string folder = make_scratch_folder();
    mt_mesh *mesh = wavy_torus(face_count, false, false);
    require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
    std::string ply = folder + "/mesh.ply";
    require(shared_context(), mt_mesh_write_file(shared_context(), mesh, ply.c_str(), nullptr, nullptr));
    if (installed("f3d") && installed("Xvfb")) {
        Screen screen;
        beside("f3d", folder,
               std::string("DISPLAY=") + display + " f3d " + ply + " --output " + folder +
                   "/f3d.png --resolution 1024,1024");
    } else {
        std::puts("preview, whole process: f3d or xvfb is not installed, left out");
    }
    if (installed("povray")) {
        write_scene(mesh, folder + "/scene.pov");
        beside("povray", folder,
               "povray +I" + folder + "/scene.pov +O" + folder + "/povray.png +W1024 +H1024 -D +A0.3 -GA");
    } else {
        std::puts("preview, whole process: povray is not installed, left out");
    }
    mt_mesh_destroy(shared_context(), mesh);
    std::filesystem::remove_all(folder);
}

} // namespace bench
