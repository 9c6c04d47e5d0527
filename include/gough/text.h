/** @file text.h
 *  Text: the grammar of decimal numbers, common to study files, tables and the command line; UTF-8; and escapes that make any
 *  text safe to print in messages and summaries.
 *
 *  Accuracy: numbers are read to the nearest double; counts are exact.
 *  Overlap: outputs must not overlap the text.
 *  Threads: every function may be called from several threads at once; the locale has no influence and nothing is allocated.
 */
#ifndef GOUGH_TEXT_H
#define GOUGH_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Reads the decimal number at the start of a text: an optional sign, digits with at most one point, and an optional exponent
 *  (e or E, an optional sign, digits). No spaces, no hexadecimal digits, no infinity, no NaN.
 *  @param text,length  need not be terminated
 *  @param[out] value   the nearest double, ties to even; infinite if the number is too large. Written only if there is a number
 *  @return the number of bytes read; 0 if the text does not begin with a number. The locale has no influence. Allocates nothing.
 *  Safe to call concurrently. */
GOUGH_API size_t gough_decimal_read(const char *text, size_t length, double *value);

/** Reads one character of UTF-8.
 *  @param text,length  the rest of the text
 *  @param[out] code    code point of the character; may be NULL
 *  @return the number of bytes it takes; 0 if the text is empty or does not begin with valid UTF-8 (a character that is cut,
 *  overlong, a surrogate or beyond U+10FFFF). Safe to call concurrently. */
GOUGH_API size_t gough_character_read(const char *text, size_t length, unsigned *code);

/** Characters of a terminated text. Bytes that are not UTF-8 count as one each where they could begin a character. */
GOUGH_API size_t gough_character_count(const char *text);

/** The name that a misspelt word probably means: the nearest by number of letters inserted, left out, replaced or swapped with
 *  their neighbour, ignoring case; the first of several. At most a third of the word plus one letter may differ, and at most half
 *  of the longer of the two. If no name is so near: the only one that begins with the word, if it has three letters or more.
 *  @param word,length  need not be terminated
 *  @param names        terminated; each ends at its first space
 *  @return its index, or -1 if none is near enough. Safe to call concurrently. */
GOUGH_API int gough_word_nearest(const char *word, size_t length, const char *const *names,
                                 size_t count);

/** A piece of a text: bytes from `begin` up to, but without, `end`. */
typedef struct gough_piece {
    const char *begin; /**< first byte */
    const char *end;   /**< one past the last byte */
} gough_piece;

/** Takes the next line of a CSV text: up to LF or CR LF, which are not part of it, or up to the end of the text.
 *  @param[in,out] rest  what is left of the text; after the call what follows the line
 *  @param[out] line     the line; must not be @p rest
 *  @return false, with nothing written, if nothing is left. Safe to call concurrently. */
GOUGH_API bool gough_csv_line(gough_piece *rest, gough_piece *line);

/** Takes the next cell of a CSV line: up to a comma or the end of the line, without blanks and tabs around it. A cell in double
 *  quotes ends at the closing quote, and two quotes within it stand for one; the quotes are part of the cell.
 *  @param[in,out] line  what is left of the line; after its last cell `begin` is NULL
 *  @param[out] cell     the cell; must not be @p line
 *  @return false, with nothing written, after the last cell. Safe to call concurrently. */
GOUGH_API bool gough_csv_cell(gough_piece *line, gough_piece *cell);

/** The same for a line whose cells are separated by another character: a semicolon, a tab, or with ' ' any number of blanks and
 *  tabs, which may also stand before the first cell and after the last. Safe to call concurrently. */
GOUGH_API bool gough_csv_cell_by(gough_piece *line, char separator, gough_piece *cell);

/** Whether nothing but line ends is left, as editors leave them at the end of a file. Safe to call concurrently. */
GOUGH_API bool gough_csv_ended(gough_piece rest);

/** Number of cells in a line that no cell was taken of. Safe to call concurrently. */
GOUGH_API size_t gough_csv_count(gough_piece line);

/** Room for any character as gough_character_show() writes it, with the terminating zero. */
enum { GOUGH_SHOWN_CHARACTER = 12 };

/** One character of a text in a form that is safe to show: printable characters as they are, and control characters, marks that
 *  change the direction of text, other characters without a glyph, and bytes that are not UTF-8 as escapes (\\x1b, \\u202e,
 *  \\U000e0041).
 *  @param text,length  the rest of the text, at least one byte
 *  @param[out] shown   the character or its escape, terminated
 *  @return the number of bytes of @p text that it stands for, at least 1. Safe to call concurrently. */
GOUGH_API size_t gough_character_show(const char *text, size_t length,
                                      char shown[GOUGH_SHOWN_CHARACTER]);

/** A whole text in that form. It is cut at the end if it does not fit, but never within a character or an escape.
 *  @param[out] shown  at most @p size bytes, terminated; may be NULL if @p size is 0
 *  @return the bytes that the whole form takes, without the terminating zero. Safe to call concurrently. */
GOUGH_API size_t gough_text_show(const char *text, size_t length, char *shown, size_t size);

#ifdef __cplusplus
}
#endif
#endif
