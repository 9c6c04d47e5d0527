/* The table of verbs, from verbs.def. */
#include "cli/common/verb.h"

#define VERB(name) extern const command_verb name##_verb;
#include "cli/verbs.def"
#undef VERB

#define VERB(name) &name##_verb,
static const command_verb *const verbs[] = {
#include "cli/verbs.def"
};
#undef VERB

const command_verb *verb_at(size_t n) { return n < sizeof verbs / sizeof *verbs ? verbs[n] : NULL; }
