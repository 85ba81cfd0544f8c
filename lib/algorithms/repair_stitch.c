/* Welding where vertices are split as well. Each undoes the other: welding everything and splitting what it made would
 * part the same places in another way each time that a step between them turned or added a face. So welding is only
 * done where something of it outlasts the split.
 *
 * Faces that welding would connect are one cluster. Two trials, with the steps up to the split, tell for each cluster
 * what welding leaves and what not welding leaves; it is welded where that leaves fewer boundary sides, or as many and
 * fewer faces. Invariant: on a mesh without any defect the second trial changes nothing, so a weld lowers the number of
 * boundary sides or, at the same number, that of faces; filling lowers the first and nothing raises it: rounds end.
 *
 * Cost: two copies of the mesh and the steps on each; none of it where no two vertices are at one place. Known
 * weakness: a cluster is welded as a whole or not at all. */
#include "lib/algorithms/repair_state.h"

#include <meshtool/edge_pairs.h>

typedef struct cluster_tally {
    mt_index boundary_sides, faces;
} cluster_tally;

typedef struct stitch_job {
    repair_state *state;
    const mt_repair_options *options;
    mt_index *numbers; /* vertex -> place */
    mt_index place_count;
    mt_index *parents;         /* place -> a place of its cluster, itself at the root */
    cluster_tally *tallies[2]; /* per root; left by not welding and by welding */
} stitch_job;

static mt_index find_root(mt_index *parents, mt_index place)
{
    while (parents[place] != place) {
        parents[place] = parents[parents[place]];
        place = parents[place];
    }
    return place;
}

static void join_clusters(stitch_job *job)
{
    const mt_mesh *mesh = job->state->mesh;
    for (mt_index place = 0; place < job->place_count; place++) {
        job->parents[place] = place;
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        mt_index first = find_root(job->parents, job->numbers[mesh->corner_vertices[begin]]);
        for (mt_index corner = begin + 1; corner < end; corner++) {
            mt_index other = find_root(job->parents, job->numbers[mesh->corner_vertices[corner]]);
            job->parents[first < other ? other : first] = first < other ? first : other;
            first = first < other ? first : other;
        }
    }
}

static mt_status tally_faces(stitch_job *job, const repair_state *trial, cluster_tally *tallies)
{
    const mt_mesh *given = job->state->mesh, *mesh = trial->mesh;
    mt_edge_pairs *pairs;
    mt_status status = mt_edge_pairs_create(trial->context, mesh, &pairs);
    if (status != MT_OK) {
        return status;
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index source = mt_mesh_face_begin(given, trial->face_origins[face]);
        mt_index place = job->numbers[given->corner_vertices[source]];
        cluster_tally *tally = &tallies[find_root(job->parents, place)];
        tally->faces++;
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            tally->boundary_sides += mt_edge_class_of(mesh, pairs, corner) == MT_EDGE_BOUNDARY;
        }
    }
    mt_edge_pairs_destroy(trial->context, pairs);
    return MT_OK;
}

static mt_status take_steps(repair_state *trial, const mt_repair_options *options)
{
    mt_repair_report unused = {0};
    mt_status status = MT_OK;
    if (options->steps[MT_REPAIR_DROP_DEGENERATE]) {
        status = mt_repair_drop_degenerate(trial, &unused.results[MT_REPAIR_DROP_DEGENERATE]);
    }
    if (status == MT_OK && options->steps[MT_REPAIR_DROP_DUPLICATES]) {
        status = mt_repair_drop_duplicates(trial, &unused.results[MT_REPAIR_DROP_DUPLICATES]);
    }
    if (status == MT_OK) {
        status = mt_repair_split(trial, &unused.results[MT_REPAIR_SPLIT]);
    }
    mt_repair_report_release(trial->context, &unused);
    return status;
}

static mt_status try_steps(stitch_job *job, bool weld)
{
    mt_context *context = job->state->context;
    repair_state trial;
    mt_status status = mt_repair_state_init(context, job->state->mesh, &trial);
    if (status == MT_OK && weld) {
        mt_repair_result unused = {0};
        status = mt_repair_join(&trial, job->numbers, job->place_count, &unused);
        mt_free(context, unused.vertices);
    }
    if (status == MT_OK) {
        status = take_steps(&trial, job->options);
    }
    if (status == MT_OK) {
        status = tally_faces(job, &trial, job->tallies[weld]);
    }
    mt_repair_state_release(&trial);
    return status;
}

static bool is_welded(const stitch_job *job, mt_index place)
{
    mt_index root = find_root(job->parents, place);
    const cluster_tally *apart = &job->tallies[false][root], *welded = &job->tallies[true][root];
    if (apart->faces == 0) {
        return true; /* points and ends of wires, which nothing splits */
    }
    return welded->boundary_sides != apart->boundary_sides ? welded->boundary_sides < apart->boundary_sides
                                                           : welded->faces < apart->faces;
}

/* Numbers the vertices anew: one number a place where it is welded, one a vertex elsewhere. `parents` is done with and
 * becomes the numbers of the places. */
static mt_index number_again(stitch_job *job, uint8_t *welded)
{
    for (mt_index place = 0; place < job->place_count; place++) {
        welded[place] = is_welded(job, place);
    }
    for (mt_index place = 0; place < job->place_count; place++) {
        job->parents[place] = MT_NONE;
    }
    mt_index count = 0;
    for (mt_index vertex = 0; vertex < job->state->mesh->vertex_count; vertex++) {
        mt_index place = job->numbers[vertex];
        if (!welded[place] || job->parents[place] == MT_NONE) {
            job->parents[place] = count++;
        }
        job->numbers[vertex] = job->parents[place];
    }
    return count;
}

static mt_status stitch(stitch_job *job, mt_index *distinct_count)
{
    join_clusters(job);
    mt_status status = try_steps(job, false);
    if (status == MT_OK) {
        status = try_steps(job, true);
    }
    uint8_t *welded = status == MT_OK ? mt_allocate(job->state->context, job->place_count) : NULL;
    if (welded) {
        *distinct_count = number_again(job, welded);
        mt_free(job->state->context, welded);
    } else if (status == MT_OK) {
        status = MT_ERROR_OUT_OF_MEMORY;
    }
    return status;
}

mt_status mt_repair_choose_welds(repair_state *state, const mt_repair_options *options, mt_index *numbers,
                                 mt_index *distinct_count)
{
    mt_context *context = state->context;
    stitch_job job = {.state = state, .options = options, .numbers = numbers, .place_count = *distinct_count};
    job.parents = mt_allocate_array(context, job.place_count, sizeof *job.parents);
    job.tallies[false] = mt_allocate_array_zeroed(context, job.place_count, sizeof(cluster_tally));
    job.tallies[true] = mt_allocate_array_zeroed(context, job.place_count, sizeof(cluster_tally));
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (job.parents && job.tallies[false] && job.tallies[true]) {
        status = stitch(&job, distinct_count);
    }
    mt_free(context, job.tallies[true]);
    mt_free(context, job.tallies[false]);
    mt_free(context, job.parents);
    return status;
}
