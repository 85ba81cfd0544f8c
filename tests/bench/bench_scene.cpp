// A scene with a mirror and shadows over a mesh of a million triangles, one sample a pixel: whole processes beside
// POV-Ray, which reads the same triangles as text where we read a binary PLY; and the drawing alone, in memory, on one
// thread and on all, beside POV-Ray's own account of its tracing in the note.
#include "tests/bench/bench.hpp"

#include <meshtool/scene.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace bench
{
namespace
{

constexpr std::uint64_t face_count = 1000000;

const char scene_json[] = R"({
  "image": {"width": 1024, "height": 1024, "samples": 1},
  "camera": {"eye": [0, 2.4, 3.4], "target": [0, 0, 0], "fov": 40},
  "background": {"color": [0.2, 0.3, 0.5]}, "ambient": 0.15,
  "lights": [{"kind": "point", "position": [-3, 5, 4]}],
  "materials": {"mirror": {"color": 0, "mirror": 0.8}, "dull": {"color": 0.8, "specular": 0.5, "exponent": 50}},
  "meshes": {"torus": {"file": "mesh.ply"}},
  "objects": [{"kind": "plane", "point": [0, -1, 0], "material": "dull"},
              {"kind": "sphere", "center": [0.2, 0.4, -1.6], "radius": 1.2, "material": "mirror"},
              {"kind": "mesh", "mesh": "torus", "material": "dull"}]
})";

// POV-Ray's z runs away from the eye, so that of the mesh is turned.
void write_povray(const mt_mesh *mesh, const std::string &path)
{
    std::ofstream out(path);
    out << "#version 3.7;\nglobal_settings { assumed_gamma 1 ambient_light rgb 1 max_trace_level 9 }\n"
           "camera { location <0, 2.4, -3.4> look_at <0, 0, 0> right x angle 40 }\nbackground { rgb <0.2, 0.3, 0.5> }\n"
           "light_source { <-3, 5, -4> rgb 1 }\n"
           "#declare dull = texture { pigment { rgb 0.8 } finish { ambient 0.15 diffuse 1 specular 0.5 roughness 0.02 "
           "} }\n"
           "plane { y, -1 texture { dull } }\n"
           "sphere { <0.2, 0.4, 1.6>, 1.2 pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 0.8 } }\n"
           "mesh2 {\nvertex_vectors { "
        << mesh->vertex_count;
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        mt_vec3 p = mt_mesh_position(mesh, i);
        out << ",\n<" << p.x << ',' << p.y << ',' << -p.z << '>';
    }
    out << " }\nface_indices { " << mesh->face_count;
    for (mt_index i = 0; i < mesh->face_count; i++) {
        const mt_index *c = mesh->corner_vertices + 3 * static_cast<std::size_t>(i);
        out << ",\n<" << c[0] << ',' << c[1] << ',' << c[2] << '>';
    }
    out << " }\ntexture { dull } }\n";
}

void compare_processes(const std::string &folder)
{
    Row row;
    row.name = "scene, whole process";
    row.mesh = "torus";
    row.faces = face_count;
    row.peer = "povray";
    row.note = "mirror and shadow, 1024 x 1024, one sample a pixel";
    std::string ours = std::string(MESHTOOL_BINARY) + " render " + folder + "/scene.json -o " + folder + "/ours.png";
    std::string theirs = "povray +I" + folder + "/scene.pov +O" + folder + "/povray.png +W1024 +H1024 -D -A -GA +WT1";
    compare(
        row,
        [&](mt_context *context) {
            run_quietly(ours + " --threads " + std::to_string(mt_context_thread_count(context)));
        },
        [&] { run_quietly(theirs); });
}

// The same scene in memory: one thread stands in the peer's place, so that the ratio of all threads is their gain.
void compare_threads(const mt_mesh *mesh)
{
    mt_scene_light light = {MT_LIGHT_POINT, {-3, 5, 4}, {1, 1, 1}, 0, true};
    mt_material materials[2] = {mt_material_default(), mt_material_default()};
    materials[0].color = {0, 0, 0};
    materials[0].mirror = {0.8, 0.8, 0.8};
    mt_scene_mesh meshes[1] = {{mesh, MT_SHADING_CREASE, 0, false}};
    mt_scene_object objects[3] = {};
    objects[0].kind = MT_OBJECT_PLANE;
    objects[0].material = 1;
    objects[0].shape.plane = {{0, -1, 0}, {0, 1, 0}};
    objects[1].kind = MT_OBJECT_SPHERE;
    objects[1].shape.sphere = {{0.2, 0.4, -1.6}, 1.2};
    objects[2].kind = MT_OBJECT_MESH;
    objects[2].material = 1;
    objects[2].shape.transform = mt_transform_identity();
    mt_scene scene{};
    scene.camera.eye = {0, 2.4, 3.4};
    scene.samples = 4;
    scene.ambient = {0.15, 0.15, 0.15};
    scene.background.color = {0.2, 0.3, 0.5};
    scene.light_count = 1, scene.lights = &light;
    scene.material_count = 2, scene.materials = materials;
    scene.mesh_count = 1, scene.meshes = meshes;
    scene.object_count = 3, scene.objects = objects;
    auto draw = [&](mt_context *context) {
        mt_image *image = nullptr;
        require(context, mt_scene_render(context, &scene, nullptr, &image, nullptr));
        mt_image_destroy(context, image);
    };
    Row row;
    row.name = "scene, in memory";
    row.mesh = "torus";
    row.faces = face_count;
    row.peer = "1 thread";
    row.note = "mirror and shadow, 1024 x 1024, four samples a pixel; tree and normals included";
    compare(row, draw, [&] { draw(shared_context()); });
}

} // namespace

void run_scene()
{
    std::string folder = make_scratch_folder();
    mt_mesh *mesh = wavy_torus(face_count, false, false);
    require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
    std::string ply = folder + "/mesh.ply";
    require(shared_context(), mt_mesh_write_file(shared_context(), mesh, ply.c_str(), nullptr, nullptr));
    std::ofstream(folder + "/scene.json") << scene_json;
    if (installed("povray")) {
        write_povray(mesh, folder + "/scene.pov");
        compare_processes(folder);
    } else {
        std::puts("scene, whole process: povray is not installed, left out");
    }
    compare_threads(mesh);
    mt_mesh_destroy(shared_context(), mesh);
    std::filesystem::remove_all(folder);
}

} // namespace bench
