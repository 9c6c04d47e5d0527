/** @file fields.h
 *  Every field of a study as data: the keys of the study file with their types, units, ranges and defaults, and the members of
 *  gough_model, gough_simulation, gough_move and gough_external that they fill. One table drives the reader of study files,
 *  the flat form of models, sweeps and output; bindings and exports can use it too.
 *
 *  Accuracy: defaults are exact.
 *  Overlap: a place is not part of the struct that is reset.
 *  Threads: every function may be called from several threads at once, on distinct structs.
 */
#ifndef GOUGH_FIELDS_H
#define GOUGH_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How the value of a key is written in a study file. */
typedef enum gough_shape {
    GOUGH_SHAPE_MAPPING,         /**< keys and values */
    GOUGH_SHAPE_MOVES,           /**< a list of mappings */
    GOUGH_SHAPE_LOADS,           /**< likewise */
    GOUGH_SHAPE_TEXT,            /**< text */
    GOUGH_SHAPE_FILE,            /**< path of a file */
    GOUGH_SHAPE_CHOICE,          /**< one of the words in the range */
    GOUGH_SHAPE_NUMBER,          /**< a number */
    GOUGH_SHAPE_NUMBER_OR_LEAST, /**< a number, or the word least */
    GOUGH_SHAPE_WHOLE,           /**< a number without decimals */
    GOUGH_SHAPE_PAIR,            /**< two numbers */
    GOUGH_SHAPE_VECTOR,          /**< three numbers */
    GOUGH_SHAPE_GRAVITY,         /**< a number within the bound, or any three numbers */
    GOUGH_SHAPE_NUMBER_OR_SIX,   /**< a number for all legs, or one for each */
    GOUGH_SHAPE_PAIR_OR_SIX,     /**< two numbers for all legs, or two for each */
    GOUGH_SHAPE_RANGE,           /**< two numbers, or one that stands for −x and x */
    GOUGH_SHAPE_POINTS,          /**< six points of three numbers */
    GOUGH_SHAPE_INERTIA,         /**< three numbers, or a matrix of three rows */
    GOUGH_SHAPE_FORMULA,         /**< a formula in t */
    GOUGH_SHAPE_FORMULA_OR_SIX,  /**< a formula for all legs, or one for each */
    GOUGH_SHAPE_FORMULA_VECTOR,  /**< three formulas */
    GOUGH_SHAPE_CONSTRAINTS,     /**< one of the words in the range, or a mapping */
    GOUGH_SHAPE_SMOOTH,          /**< likewise */
    GOUGH_SHAPE_UNITS,           /**< likewise */
    GOUGH_SHAPE_SWEPT,           /**< a mapping of paths to the values they take */
    GOUGH_SHAPE_VARIED,          /**< a mapping of paths to two numbers, the least first */
    GOUGH_SHAPE_AIMS,            /**< one of the words in the range, or a mapping */
    GOUGH_SHAPE_DRIVES,          /**< a mapping for all legs, or one for each */
    GOUGH_SHAPE_RANGE_OR_SIX,    /**< as GOUGH_SHAPE_RANGE for all legs, or one for each */
    GOUGH_SHAPE_SAMPLES,         /**< path of a file, or a mapping */
    GOUGH_SHAPE_COLUMN,          /**< name or number of a column, or a mapping */
    GOUGH_SHAPE_COLUMNS,         /**< a mapping of names to columns */
    GOUGH_SHAPE_GAINS /**< as GOUGH_SHAPE_NUMBER_OR_SIX, or a matrix of six rows of any six
                                     numbers: [leg that pushes][leg whose error it is] */
} gough_shape;

/** Parts of a study, as flags. */
enum gough_part {
    GOUGH_PART_NONE = 0,        /**< none of those below */
    GOUGH_PART_MACHINE = 1,     /**< platform, load, gravity */
    GOUGH_PART_HEIGHT = 2,      /**< the height at home; set together with GOUGH_PART_MACHINE */
    GOUGH_PART_MOTION = 4,      /**< the program */
    GOUGH_PART_DISTURBANCE = 8, /**< the disturbances */
    GOUGH_PART_CONTROL = 16,    /**< the control law */
    GOUGH_PART_INITIAL = 32,    /**< where runs start */
    GOUGH_PART_SIMULATION = 64, /**< how they are run */
    GOUGH_PART_EXTERNAL = 128,  /**< the external loads */
    GOUGH_PART_WORKSPACE = 256  /**< demands on all poses */
};

/** The struct that contains a field. */
typedef enum gough_owner {
    GOUGH_OWNER_NONE,       /**< none: a mapping, or a key from which members are computed */
    GOUGH_OWNER_MODEL,      /**< gough_model */
    GOUGH_OWNER_SIMULATION, /**< gough_simulation */
    GOUGH_OWNER_MOVE,       /**< gough_move, one for each element of motion.moves */
    GOUGH_OWNER_EXTERNAL    /**< gough_external, one for each element of external */
} gough_owner;

/** Type of a field's values in its struct. */
typedef enum gough_kind {
    GOUGH_KIND_NUMBER,  /**< double */
    GOUGH_KIND_FORMULA, /**< gough_formula */
    GOUGH_KIND_FLAG,    /**< bool; of a choice between two words, true for the first */
    GOUGH_KIND_CHOICE,  /**< an enumeration: the place of its word in the range, from 0 */
    GOUGH_KIND_WHOLE    /**< uint64_t */
} gough_kind;

/** Range of the numbers of a key. */
typedef struct gough_bound {
    const char *rule; /**< "greater than 0": what a number must be; "" without a bound */
    double least;     /**< least number, or -INFINITY */
    double greatest;  /**< greatest number, or INFINITY */
    bool open;        /**< the least number itself is excluded */
} gough_bound;

/** The member of a struct in which a field is kept. Of "control.stiffness", the value of leg 2 is
 *  `((const double *)((const char *)model + place->offset))[1]`. */
typedef struct gough_place {
    gough_owner owner; /**< struct that has it as a member */
    unsigned part;     /**< the gough_part that it belongs to */
    unsigned also;     /**< another gough_part that depends on it, or 0 */
    gough_kind kind; /**< type of its values; this and the following are set if there is an owner */
    size_t offset;   /**< bytes from the start of the struct to the first value */
    size_t count;    /**< values, one after the other: 6 for "control.stiffness" */
    size_t given;    /**< offset of the flag that tells whether the key is given; 0: no such flag */
    int choices;     /**< values of an enumeration */
    double usual[2]; /**< default of the values: of the first, and of the others */
} gough_place;

/** One field: a key of the study file, a member of a struct, or usually both. */
typedef struct gough_field {
    const char *
        path; /**< "platform.base.radius"; "motion.moves.N.start" for each element of a list; unique */
    const char *type; /**< of a key: "number", "formula", "choice", … */
    const char *
        unit; /**< "length", "force/length", "" …; "angle [degrees]": degrees in the file unless its units name another angle,
                 radians in the struct */
    const char *range;    /**< "> 0" …; words of a choice, separated by ", " */
    const char *fallback; /**< default as text, "required", or "" */
    const char *sentence; /**< what it is */

    bool is_key;       /**< it is a key of the study file; else only path and place are set */
    gough_shape shape; /**< how the key's value is written */
    gough_bound bound; /**< of its numbers */
    gough_place place; /**< the member that it fills */
} gough_field;

/** All fields: first the keys in the order of the guide, then members that no key names. Constant data.
 *  @param[out] count  number of fields; may be NULL */
GOUGH_API const gough_field *gough_fields(size_t *count);

/** Sets the values in a place to their default, and the flag that tells whether the key is given to false.
 *  @param owner  the struct that `place->owner` names; not changed if it is GOUGH_OWNER_NONE */
GOUGH_API void gough_place_reset(const gough_place *place, void *owner);

#ifdef __cplusplus
}
#endif
#endif
