/* Bytes of a file, and the guard that stands before the YAML parser: what passes it is short, valid UTF-8 text. */
#define _POSIX_C_SOURCE 200809L
#include "study/source.h"

#include "gough/study.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "gough/text.h"

/* Reads until the end or one byte over the limit. */
static char *read_all(int file, size_t most, size_t *length) {
    size_t capacity = 65536, used = 0;
    char *text = malloc(capacity + 1);
    while (text && used <= most) {
        if (used == capacity) {
            char *larger = realloc(text, 2 * capacity + 1);
            if (!larger) break;
            text = larger;
            capacity *= 2;
        }
        const ssize_t got = read(file, text + used, capacity - used);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0) {
            text[used] = '\0';
            *length = used;
            return text;
        }
        if (got < 0) break;
        used += (size_t)got;
    }
    const int cause = used > most ? EFBIG : errno;
    free(text);
    errno = cause;
    return NULL;
}

static const char *cause_text(study_arena *arena, int cause) {
    char text[128] = "";
    (void)strerror_r(cause, text, sizeof text);
    return study_printable(arena, text);
}

/* Descriptors of the process by name: what stands behind them was opened by whoever started it. */
bool study_is_descriptor(const char *path) {
    return strcmp(path, "/dev/stdin") == 0 || strncmp(path, "/dev/fd/", 8) == 0 ||
           strncmp(path, "/proc/self/fd/", 14) == 0;
}

/* The descriptor; or -1 with what else it is in *kind, or NULL there and errno set. */
static int open_input(const char *path, const char **kind) {
    struct stat about;
    const bool given = study_is_descriptor(path);
    *kind = NULL;
    /* opening a pipe that nobody writes to would wait */
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | (given ? 0 : O_NONBLOCK));
    if (file < 0) return -1;
    if (fstat(file, &about) != 0) {
        close(file);
        return -1;
    }
    if (S_ISREG(about.st_mode) || (given && !S_ISDIR(about.st_mode))) return file;
    close(file);
    *kind = S_ISDIR(about.st_mode)    ? "a folder"
            : S_ISFIFO(about.st_mode) ? "a named pipe"
                                      : "a device"; /* a socket cannot be opened */
    return -1;
}

int gough_open_input(const char *path, gough_error *error) {
    const char *kind;
    char cause[128] = "";
    if (strcmp(path, "-") == 0) return STDIN_FILENO;
    const int file = open_input(path, &kind);
    if (file >= 0) return file;
    (void)strerror_r(errno, cause, sizeof cause);
    if (kind)
        gough_fail(error, GOUGH_ERROR_FILE, "%s: is %s; a regular file is needed", path, kind);
    else
        gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot open: %s", path, cause);
    return -1;
}

/* Opens it; -1 with what is wrong said. */
static int open_source(study_messages *messages, study_place place, const char *path) {
    const char *kind = NULL;
    const int file = open_input(path, &kind);
    if (file >= 0) return file;
    const char *name = study_printable(messages->arena, path);
    if (kind)
        study_say(messages, GOUGH_ERROR_FILE, place, "`%s` is %s; a regular file is needed", name,
                  kind);
    else
        study_say(messages, GOUGH_ERROR_FILE, place, "cannot open `%s`: %s", name,
                  cause_text(messages->arena, errno));
    return -1;
}

char *study_source_read(study_messages *messages, study_place place, const char *path, size_t most,
                        size_t *length) {
    const bool standard = strcmp(path, "-") == 0;
    const int file = standard ? STDIN_FILENO : open_source(messages, place, path);
    if (file < 0) return NULL;
    const char *name = study_printable(messages->arena, path);
    const char *other = gough_input_kind(file, GOUGH_INPUT_STUDY);
    char *text = NULL;
    if (other) {
        study_say(messages, GOUGH_ERROR_INPUT, place,
                  "`%s` is %s; a study is YAML text, such as `gough example` prints", name, other);
    } else {
        text = read_all(file, most, length);
        if (!text && errno == EFBIG)
            study_say(messages, GOUGH_ERROR_INPUT, place,
                      "`%s` is larger than the %zu KiB that such a file may have", name,
                      most / 1024);
        else if (!text)
            study_say(messages, GOUGH_ERROR_FILE, place, "cannot read `%s`: %s", name,
                      cause_text(messages->arena, errno));
    }
    if (!standard) close(file);
    return text;
}

/* Whether the first character of a text is the brace or bracket of JSON. */
static bool is_json(int file) {
    char bytes[256];
    const ssize_t got = pread(file, bytes, sizeof bytes, 0);
    for (ssize_t i = 0; i < got; i++)
        if (!strchr(" \t\r\n", bytes[i])) return bytes[i] == '{' || bytes[i] == '[';
    return false;
}

int study_record_open(study_messages *messages, study_place place, const char *path, size_t most) {
    struct stat about = {.st_mode = S_IFREG};
    const int file = open_source(messages, place, path);
    if (file < 0) return -1;
    const char *name = study_printable(messages->arena, path);
    const char *other = gough_input_kind(file, GOUGH_INPUT_CSV);
    if (other || is_json(file))
        study_say(messages, GOUGH_ERROR_INPUT, place,
                  "`%s` is %s; recorded motion is a table in CSV with a column `t`%s", name,
                  other ? other : "JSON",
                  other ? ""
                        : ", which `jq -r '.[] | [.t, .heave] | @csv'` makes of a list of such "
                          "objects");
    else if (fstat(file, &about) == 0 && !S_ISREG(about.st_mode))
        study_say(messages, GOUGH_ERROR_FILE, place,
                  "`%s` is not a regular file; recorded motion is read from regular files only",
                  name);
    else if ((size_t)about.st_size > most)
        study_say(messages, GOUGH_ERROR_INPUT, place,
                  "`%s` is larger than the %zu MiB that a record may have", name,
                  most / 1024 / 1024);
    else
        return file;
    close(file);
    return -1;
}

static bool is_control(unsigned code) {
    if (code == '\t' || code == '\n' || code == '\r') return false;
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xFEFF || code == 0xFFFE ||
           code == 0xFFFF;
}

static bool refuse(study_messages *messages, study_place place, const char *sentence) {
    study_say(messages, GOUGH_ERROR_INPUT, place, "%s", sentence);
    return false;
}

static bool guard_character(study_messages *messages, study_place place, size_t size,
                            unsigned code) {
    const unsigned char byte = (unsigned char)place.source->text[place.offset];
    if (size == 0 && place.offset == 0 && (byte == 0xFE || byte == 0xFF))
        return refuse(messages, place, "this looks like UTF-16; save the file as UTF-8");
    if (size == 0) {
        study_say(messages, GOUGH_ERROR_INPUT, place,
                  "byte 0x%02X is not UTF-8 here; save the file as UTF-8", byte);
        return false;
    }
    if (code == 0) return refuse(messages, place, "NUL byte; a study is plain text");
    if (is_control(code)) {
        study_say(messages, GOUGH_ERROR_INPUT, place,
                  "control character U+%04X: only tabs and line ends are allowed", code);
        return false;
    }
    return true;
}

bool study_source_guard(study_messages *messages, const study_source *source, size_t begin) {
    if (source->length - begin > STUDY_MOST_BYTES) {
        study_say(messages, GOUGH_ERROR_INPUT, (study_place){source, begin},
                  "the text has %zu bytes; the limit is %d", source->length - begin,
                  STUDY_MOST_BYTES);
        return false;
    }
    bool line_start = true;
    for (size_t at = begin; at < source->length;) {
        unsigned code = 0;
        const study_place place = {source, at};
        const size_t size = gough_character_read(source->text + at, source->length - at, &code);
        if (!guard_character(messages, place, size, code)) return false;
        if (line_start && code == '%')
            return refuse(messages, place,
                          "lines must not begin with %: directives are not allowed in a study");
        line_start = code == '\n' || code == '\r';
        at += size;
    }
    return true;
}
