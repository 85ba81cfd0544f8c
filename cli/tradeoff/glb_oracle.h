/* The vertices of a GLB file, taken apart by the format's own words, without the reader. */
#ifndef MESHTOOL_CLI_TRADEOFF_GLB_ORACLE_H
#define MESHTOOL_CLI_TRADEOFF_GLB_ORACLE_H

#include <stdbool.h>
#include <stddef.h>

/* Puts 3 * count numbers at `positions`: integers of the first primitive's POSITION, scaled and moved as the one node
 * says. False when the bytes are no such file (glTF 2.0, sections 3.5.2, 3.6.2 and 4.4; KHR_mesh_quantization). */
bool glb_oracle_positions(const void *bytes, size_t size, size_t count, double *positions);

#endif
