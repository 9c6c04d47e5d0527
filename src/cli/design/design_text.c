/* gough design for reading: the keys, the objective, what keeps it from being better, and the certificate. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/design/design_verb.h"

enum { INDENT = 23 };

static const char *aim_words(gough_aim aim) {
    static const char *const words[GOUGH_AIMS] = {"greatest force of a leg", "stroke of a leg",
                                                  "greatest speed of a leg", "footprint"};
    return words[aim];
}

static void print_keys(const design_answer *a) {
    printf("%s\n", a->result.found ? "Keys chosen" : "Keys nearest to the requirement");
    printf("  %-40s %12s %12s   %s\n", "", "study", a->result.found ? "design" : "nearest",
           "between");
    for (size_t k = 0; k < a->keys; k++) {
        char head[120];
        const char *word = key_word(a, k);
        snprintf(head, sizeof head, "%s%s%s%s", a->key[k].path, *word ? " [" : "",
                 *word ? word + 1 : "", *word ? "]" : "");
        printf("  %-40s %12.7g %12.7g   %.6g and %.6g\n", head, a->key[k].start, a->result.value[k],
               a->key[k].least, a->key[k].greatest);
    }
}

static void print_aims(const design_answer *a) {
    printf("\nWhat is made least, at the corners of workspace.box\n");
    for (int k = 0; k < GOUGH_AIMS; k++) {
        const gough_unit unit = aim_unit((gough_aim)k);
        const double *aim = a->result.aim[k];
        if (!(a->request.weight[k] > 0)) continue;
        const char *word = unit_word(a->unit, unit);
        char head[60];
        snprintf(head, sizeof head, "%s%s%s%s", aim_words((gough_aim)k), *word ? " [" : "",
                 *word ? word + 1 : "", *word ? "]" : "");
        printf("  %-40s %12.6g %12.6g", head, in_units(a->unit, unit, aim[0]),
               in_units(a->unit, unit, aim[1]));
        if (aim[0] > 0 && isfinite(aim[1])) printf("   %+.3g %%", 100 * (aim[1] / aim[0] - 1));
        printf("\n");
    }
    if (design_weighs(a))
        printf("  %-40s %12.6g %12.6g\n", "weighted sum of the ratios to the study",
               a->result.objective[0], a->result.objective[1]);
    if (a->result.found && !a->result.start_meets)
        print_paragraph(stdout, "  study as written", INDENT,
                        "exceeds a limit in workspace.box, or has no certificate for it");
}

/* "leg 1 at its least length (legs 4, 5 too)" */
static void print_limit(const design_answer *a, size_t first) {
    const gough_design_result *r = &a->result;
    const gough_active *one = &r->active[first];
    const binding_words words = words_of_binding(&one->binding);
    char others[80] = "";
    size_t used = 0, count = 0;
    for (size_t i = first + 1; i < r->actives; i++) {
        const gough_active *other = &r->active[i];
        if (other->kind != GOUGH_ACTIVE_LIMIT || other->binding.bind != one->binding.bind) continue;
        used += (size_t)snprintf(others + used, sizeof others - used, "%s%d", count++ ? ", " : "",
                                 other->binding.which + 1);
    }
    printf("  %s", words.text);
    if (count) printf(" (leg%s %s too)", count > 1 ? "s" : "", others);
    printf(": ");
    workspace_print_pose(a->unit, one->pose);
}

static void print_actives(const design_answer *a) {
    const gough_design_result *r = &a->result;
    printf("\nWhat keeps it from being better\n");
    if (r->actives == 0)
        printf("  no bound and no limit: the search found nothing better between the bounds\n");
    for (size_t i = 0; i < r->actives; i++) {
        const gough_active *active = &r->active[i];
        bool first = true;
        for (size_t k = 0; k < i; k++)
            first &= r->active[k].kind != active->kind ||
                     r->active[k].binding.bind != active->binding.bind;
        if (active->kind == GOUGH_ACTIVE_LEAST || active->kind == GOUGH_ACTIVE_GREATEST)
            printf("  %s at its %s, %.6g%s: give it room\n", a->key[active->key].path,
                   gough_active_name(active->kind),
                   active->kind == GOUGH_ACTIVE_LEAST ? a->key[active->key].least
                                                      : a->key[active->key].greatest,
                   key_word(a, active->key));
        else if (active->kind == GOUGH_ACTIVE_TELESCOPE)
            printf("  design.telescope: the legs cannot be shorter for their greatest length\n");
        else if (first)
            print_limit(a, i);
    }
}

/* what the search asked for beyond the limits, so that the proof could be found */
static void print_spare(const gough_design_result *r) {
    for (int kind = 0; kind < GOUGH_BINDS; kind++)
        if (r->spare[kind] > 0)
            printf(
                "  the search left %.3g %% of the limit %s to spare, so that a proof was found\n",
                100 * r->spare[kind], gough_bind_name((gough_bind)kind));
    if (r->singular_value > 0)
        printf("  the search asked for a least singular value of %.4g\n", r->singular_value);
}

static void print_certificate(const design_answer *a) {
    const gough_design_result *r = &a->result;
    printf("\nCertificate\n");
    if (r->found) {
        printf("  every pose of workspace.box keeps every limit; %zu boxes tested\n", r->tests);
        print_spare(r);
        return;
    }
    const binding_words words = words_of_binding(&r->certificate.binding);
    if (r->certificate.verdict == GOUGH_OUTSIDE) {
        printf("  %s: ", r->telescope_fails ? "design.telescope" : words.text);
        workspace_print_pose(a->unit, r->certificate.pose);
    } else if (r->certificate.verdict == GOUGH_UNDECIDED && r->certificate.tests > 0) {
        printf("  not decided in %zu boxes, near ", r->certificate.tests);
        workspace_print_pose(a->unit, r->certificate.pose);
    }
    printf("  %.4g of workspace.box is certified with these values\n", r->scale);
}

void design_print(const design_answer *a) {
    workspace_answer w = design_workspace(a);
    print_title(stdout, a->study->title);
    printf("%s\n\n", units_sentence(a->study, a->unit).text);
    print_keys(a);
    print_aims(a);
    print_actives(a);
    print_certificate(a);
    if (a->result.found) workspace_print_envelope(&w);
    printf("\n%zu designs tried\n", a->result.evaluations);
}
