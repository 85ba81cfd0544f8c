/* meshtool subdivide: Catmull-Clark refinement. */
#include "crease_list.h"
#include "files.h"
#include "message.h"
#include "profile.h"
#include "progress.h"
#include "subdivision.h"

#include <meshtool/elementary.h>

/* Each list begins with what the mesh asks for by its tags, as the library's enumerations do. */
static const char *const schemes[] = {"catmull-clark", "loop", NULL};
static const char *const boundaries[] = {"as-tagged", "smooth", "corners", "none", NULL};
static const char *const crease_methods[] = {"as-tagged", "normal", "chaikin", NULL};
static const char *const triangles[] = {"as-tagged", "normal", "smooth", NULL};
static const char *const non_manifolds[] = {"refuse", "crease", NULL};
static const char *const face_varyings[] = {
    "as-tagged", "all", "none", "corners-only", "corners-plus1", "corners-plus2", "boundaries", "linear", NULL};
#define LINEAR_PLACE 7 /* of "linear", another word for all */

static const cli_option options[] = {
    {.name = "levels",
     .letter = 'n',
     .offset = offsetof(cli_subdivide_settings, levels),
     .parse = cli_parse_count,
     .argument = "LEVELS",
     .expects = "a whole number from 0 to 31",
     .maximum = MT_SUBDIVIDE_LEVEL_LIMIT,
     .help = "how often to refine, each level making four times the faces; 1"},
    {.name = "scheme",
     .offset = offsetof(cli_subdivide_settings, scheme),
     .parse = cli_parse_choice,
     .argument = "SCHEME",
     .expects = "catmull-clark or loop",
     .choices = schemes,
     .help =
         "catmull-clark: any faces, which become quads; loop: triangles, each of which becomes four; catmull-clark"},
    {.name = "boundary",
     .offset = offsetof(cli_subdivide_settings, boundary),
     .parse = cli_parse_choice,
     .argument = "RULE",
     .expects = "smooth, corners, none or as-tagged",
     .choices = boundaries,
     .help = "smooth: boundaries are B-splines; corners: and vertices of one face stay; none: the faces at boundaries "
             "become holes; smooth, unless the file has a tag"},
    {.name = "crease-angle",
     .offset = offsetof(cli_subdivide_settings, crease_angle),
     .parse = cli_parse_number,
     .argument = "DEGREES",
     .expects = "an angle above 0 and up to 180",
     .minimum = 1e-9,
     .maximum = 180,
     .help = "keep edges sharp at which faces turn by more than this"},
    {.name = "creases",
     .offset = offsetof(cli_subdivide_settings, creases),
     .parse = cli_parse_text,
     .argument = "FILE",
     .expects = "a file",
     .help = "lines of \"crease A B SHARPNESS\", \"corner V SHARPNESS\" and \"hole F\", all counted from 0"},
    {.name = "crease-method",
     .offset = offsetof(cli_subdivide_settings, crease_method),
     .parse = cli_parse_choice,
     .argument = "METHOD",
     .expects = "normal, chaikin or as-tagged",
     .choices = crease_methods,
     .help = "normal: sharpness falls by 1 a level; chaikin: it is evened out along creases, too; normal, unless the "
             "file has a tag"},
    {.name = "uv",
     .offset = offsetof(cli_subdivide_settings, face_varying),
     .parse = cli_parse_choice,
     .argument = "RULE",
     .expects = "all (or linear), none, corners-only, corners-plus1, corners-plus2, boundaries or as-tagged",
     .choices = face_varyings,
     .help = "where values at corners are linear: all, none, corners-only, corners-plus1, corners-plus2 or boundaries, "
             "as OpenSubdiv has them; all, unless the file has a tag"},
    {.name = "triangles",
     .offset = offsetof(cli_subdivide_settings, triangles),
     .parse = cli_parse_choice,
     .argument = "RULE",
     .expects = "normal, smooth or as-tagged",
     .choices = triangles,
     .help = "smooth: other weights beside triangles, which ripple less; normal, unless the file has a tag"},
    {.name = "limit",
     .offset = offsetof(cli_subdivide_settings, limit),
     .help = "move the vertices to the limit surface, and write its normals; -n 0 --limit needs quads"},
    {.name = "evaluate",
     .offset = offsetof(cli_subdivide_settings, evaluate),
     .help = "say how far the vertices of each level are from where they go in the limit; needs no -o"},
    {.name = "non-manifold",
     .offset = offsetof(cli_subdivide_settings, non_manifold),
     .parse = cli_parse_choice,
     .argument = "WAY",
     .expects = "refuse or crease",
     .choices = non_manifolds,
     .help = "crease: edges of three faces, and vertices where faces meet that share no edge, stay sharp; refuse"},
    {.name = "dry-run",
     .offset = offsetof(cli_subdivide_settings, dry_run),
     .help = "only say the counts, bytes and expected time of each level; needs no -o"},
    {0},
};

/* refined and lost: NULL when nothing is written; distance: NULL unless asked for. */
static void print_json(const cli_job *job, const mt_mesh_format *read, const mt_mesh *refined, json_t *lost,
                       json_t *distance)
{
    const cli_subdivide_settings *settings = job->settings;
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "format", cli_json_text(read->name));
    if (refined) {
        cli_json_set(object, "output", cli_json_text(job->common->output));
    }
    cli_json_set(object, "levels", cli_json_integer(settings->levels));
    if (refined) {
        cli_json_set(object, "vertices", cli_json_integer(refined->vertex_count));
        cli_json_set(object, "faces", cli_json_integer(refined->face_count));
        cli_json_set(object, "lost", json_incref(lost));
    }
    if (distance) {
        cli_json_set(object, "distance", json_incref(distance));
    }
    cli_json_print_line(object);
    json_decref(object);
}

static cli_exit refine(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read,
                       const mt_subdivide_options *how, json_t *distance)
{
    mt_mesh *refined = NULL;
    if (mt_subdivide(job->context, mesh, how, &refined) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    json_t *lost = NULL;
    cli_exit code = cli_write_mesh(job, refined, job->common->output, &lost);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, read, refined, lost, distance);
    }
    json_decref(lost);
    mt_mesh_destroy(job->context, refined);
    return code;
}

static cli_exit evaluate_and_refine(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read,
                                    const mt_subdivide_options *how)
{
    const cli_subdivide_settings *settings = job->settings;
    json_t *distance = NULL;
    cli_exit code = settings->evaluate ? cli_subdivide_evaluate(job, mesh, how, &distance) : CLI_EXIT_DONE;
    if (code == CLI_EXIT_DONE && (settings->common.output || !settings->evaluate)) {
        code = refine(job, mesh, read, how, distance);
    } else if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, read, NULL, NULL, distance);
    }
    json_decref(distance);
    return code;
}

static cli_exit run_on(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read)
{
    const cli_subdivide_settings *settings = job->settings;
    cli_crease_list list = {0};
    cli_exit code = settings->creases ? cli_crease_list_read(job, settings->creases, mesh, &list) : CLI_EXIT_DONE;
    mt_subdivide_options how = {
        .level_count = settings->levels,
        .no_levels = settings->levels == 0,
        .limit = settings->limit,
        .scheme = (mt_subdivide_scheme)settings->scheme,
        .boundary = (mt_subdivide_boundary)settings->boundary,
        .crease_method = (mt_subdivide_crease_method)settings->crease_method,
        .face_varying = settings->face_varying == LINEAR_PLACE ? MT_SUBDIVIDE_FACE_VARYING_ALL
                                                               : (mt_subdivide_face_varying)settings->face_varying,
        .triangles = (mt_subdivide_triangles)settings->triangles,
        .non_manifold = (mt_subdivide_non_manifold)settings->non_manifold,
        .crease_angle = settings->crease_angle * (MT_PI / 180),
        .creases = list.creases,
        .crease_count = list.crease_count,
        .sharp_vertices = list.corners,
        .sharp_vertex_count = list.corner_count,
        .holes = list.holes,
        .hole_count = list.hole_count,
    };
    if (code == CLI_EXIT_DONE) {
        code = settings->dry_run ? cli_subdivide_foretell(job, mesh, &how) : evaluate_and_refine(job, mesh, read, &how);
    }
    cli_crease_list_release(job, &list);
    return code;
}

/* The precision that the profile refines in, unless one is asked for. */
static cli_exit store_as_profiled(const cli_job *job, mt_mesh *mesh)
{
    mt_precision wanted = cli_profile_of(job->common)->precision;
    if (job->common->precision != MT_PRECISION_AUTO || wanted == MT_PRECISION_AUTO) {
        return CLI_EXIT_DONE;
    }
    mt_type type = wanted == MT_PRECISION_F32 ? MT_F32 : MT_F64;
    if (type == MT_F32 && mesh->position_type == MT_F64 && !job->common->quiet) {
        fputs("meshtool: --profile fast refines positions in single precision\n", stderr);
    }
    return mt_mesh_set_position_type(job->context, mesh, type, NULL) == MT_OK
               ? CLI_EXIT_DONE
               : cli_report_failure(job, job->operands[0]);
}

static cli_exit run(const cli_job *job)
{
    const cli_subdivide_settings *settings = job->settings;
    const mt_mesh_format *read = NULL, *written = NULL;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE && !settings->dry_run && (settings->common.output || !settings->evaluate)) {
        code = cli_check_mesh_output(job, settings->common.output, &written);
    }
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = store_as_profiled(job, mesh);
    }
    if (code == CLI_EXIT_DONE) {
        code = run_on(job, mesh, read);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static const cli_subdivide_settings defaults = {.levels = 1};

const cli_command cli_subdivide_command = {
    .name = "subdivide",
    .usage = "IN -o OUT [-n LEVELS]",
    .summary = "Refine a mesh by Catmull-Clark or Loop subdivision",
    .description =
        "Takes faces of any number of sides and makes quads of them (--scheme loop: triangles of triangles). Creases, "
        "corners, holes and boundaries are those "
        "of OpenSubdiv: from OBJ tags (t crease 2/1/0 A B SHARPNESS and its kin), which options beat. Colours follow "
        "the positions, texture coordinates are linear unless --uv says otherwise. A mesh that is not manifold, "
        "or whose faces are not oriented alike, is refused (exit 3); check-manifold shows where.",
    .examples = "  meshtool subdivide cow.obj -o smooth.obj -n 2\n"
                "  meshtool subdivide part.stl -o rounded.obj -n 3 --crease-angle 40\n"
                "  meshtool subdivide cage.obj -o surface.ply -n 4 --limit\n"
                "  meshtool subdivide cow.obj -n 5 --dry-run\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION |
              CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(cli_subdivide_settings),
    .defaults = &defaults,
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
