/* From the best design of a search to one that is certified. Theory: docs/theory/design.md. */
#ifndef GOUGH_DESIGN_SETTLE_H
#define GOUGH_DESIGN_SETTLE_H

#include "design/search.h"

/* Certifies the required box for a design, with what its telescope allows. GOUGH_OK if it could be decided or given up. */
gough_status design_certify(search *s, const candidate *c, gough_reach *reach,
                            gough_certificate *certificate);

/* Certifies the best design, and searches on from it while the certificate fails. Whether it ends with a design that is certified;
 * its reach and certificate are then those of s->best. */
bool design_settle(search *s, gough_design_result *result);

/* Rounds the numbers of the best design as coarsely as it stays certified and nearly as good. */
void design_round(search *s, gough_design_result *result);

/* What keeps the design from being better, (design-6). */
void design_actives(search *s, const candidate *c, gough_design_result *result);

#endif
