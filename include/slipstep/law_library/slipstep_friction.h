/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef slipstep_law_library_slipstep_friction_h
#define slipstep_law_library_slipstep_friction_h

/** @file
 * The friction law for other programs: C, Fortran, Python, user subroutines.
 *
 * The law holds no state. What a contact point remembers is an array of numbers
 * that the caller owns: a step reads the array of its start and writes that of
 * its end, so that accepting a step is copying one over the other, and giving
 * it up is doing nothing. Any number of threads may use one law at a time.
 *
 * Units are mm, s, N, MPa. Functions that may fail write a message of one line,
 * cut to the @p size of the buffer; it may be NULL.
 */

#ifdef __cplusplus
#  include <cstddef>
extern "C" {
#else
#  include <stddef.h>
#endif

typedef struct slipstep_law slipstep_law;

/** The law of a .prm file with section Friction and nothing else, as `slipstep
 * export` writes it of a case. To be freed by slipstep_law_free(). NULL if the
 * file is wrong; the message then names file and line. */
slipstep_law *slipstep_law_read(const char *file, char *message, size_t size);

/** The same of the text of such a file. */
slipstep_law *slipstep_law_parse(const char *text, char *message, size_t size);

/** The law of folder/name.prm, the name in lower case without the blanks at its
 * end: read once, kept to the end of the program, not to be freed. For user
 * subroutines, which are called anew at every point. */
slipstep_law *slipstep_law_named(const char *folder,
                                 const char *name,
                                 char       *message,
                                 size_t      size);

void slipstep_law_free(slipstep_law *law);

/** How many numbers the state of a point has. */
int slipstep_state_size(const slipstep_law *law);

/** Name with unit of one of them; the first two are the tangential traction on
 * the plane [MPa]. "" if there is no such number. */
const char *slipstep_state_name(const slipstep_law *law, int i);

/** State of a point that has not been loaded yet. */
void slipstep_initial_state(const slipstep_law *law, double *state);

/** Elastic stiffness of the contact along the plane and normal to it
 * [MPa/mm]. */
double slipstep_tangential_stiffness(const slipstep_law *law);
double slipstep_normal_stiffness(const slipstep_law *law);

/** Slip that goes back with a traction along the plane: two numbers [mm] of two
 * [MPa]. Through the stiffness, but where anisotropy stretches that. */
void slipstep_elastic_slip(const slipstep_law *law,
                           const double       *traction,
                           double             *slip);

/** Energy that a state stores per area, in the tangential stiffness and in an
 * elastic core [MPa mm]. */
double slipstep_stored_energy(const slipstep_law *law, const double *state);

/** A step in which slip and pressure change evenly, by the two implicit stages
 * that slipstep makes: in parts, if need be, so short that the error estimated
 * of each, and what two halves of it make otherwise, is at most a thousandth
 * of the strength. So steps may be of any length; where one has a part more
 * than a step nearby, the traction is off from that by as little. A law with
 * which friction jumps again and again, since it falls with speed and nothing
 * in it rises at once, has no solution.
 * @param law the law
 * @param start state before the step
 * @param slip increment of the relative displacement in the plane [mm], in axes
 *   that stay: the state has vectors, and the angles of effects are in them
 * @param pressure at the end [MPa]; not positive: open
 * @param time_step [s], positive
 * @param end state at the end; may be the array of the start
 * @param traction tangential, at the end [MPa], along positive slip
 * @param d_slip d traction[i] / d slip[j] at 2 i + j [MPa/mm], by central
 *   differences; NULL if not needed
 * @param d_pressure d traction[i] / d pressure; NULL if not needed
 * @param message,size see above
 * @return 0, or 1 for arguments that have no meaning, states that no step
 *   leaves behind and steps that have no solution; nothing is written then */
int slipstep_step(const slipstep_law *law,
                  const double       *start,
                  const double        slip[2],
                  double              pressure,
                  double              time_step,
                  double             *end,
                  double              traction[2],
                  double              d_slip[4],
                  double              d_pressure[2],
                  char               *message,
                  size_t              size);

#ifdef __cplusplus
}
#endif

#endif
