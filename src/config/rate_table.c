// SPDX-License-Identifier: GPL-3.0-or-later
// A file of shear rates: a line "TIME, RATE" for each, comments that begin with '#', empty lines.
#include "config/rate_table.h"

#include "base/memory.h"
#include "base/number.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

// A path that does not begin with '/' is seen from the folder of the run file; from here where the
// run file is not a file (--set).
static Status find_path(char path[PATH_SIZE], const Node *node, const char *file) {
    const char *slash = file[0] != '/' && node->line > 0 ? strrchr(node->source, '/') : NULL;
    const int folder = slash ? (int)(slash + 1 - node->source) : 0;
    if (snprintf(path, PATH_SIZE, "%.*s%s", folder, node->source, file) < PATH_SIZE) return OK;
    return tree_fail(node, "the path of shear_table.file is too long");
}

// Without the blanks around it.
static char *trim(char *text) {
    text += strspn(text, " \t\r");
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\r", text[length - 1])) length--;
    text[length] = '\0';
    return text;
}

static Status read_number(const char *text, const char *path, size_t line, double least,
                          double most, OptionReals *out) {
    char shown[QUOTE_SIZE];
    double value;
    if (!number_read(text, &value))
        return status_fail(BAD_DATA, "%s:%zu: error: '%s' is no number; a line is TIME, RATE", path,
                           line, tree_quote(shown, text));
    if (!(value >= least && value <= most))
        return status_fail(BAD_DATA, "%s:%zu: error: %g is not from %g to %g", path, line, value,
                           least, most);
    if (out->count == OPTION_LIST_SIZE)
        return status_fail(BAD_DATA, "%s:%zu: error: more than %d times", path, line,
                           OPTION_LIST_SIZE);
    out->values[out->count++] = value;
    return OK;
}

static Status read_line(char *line, const char *path, size_t number, Flow *flow) {
    static const double TIME_MOST = 1e12, RATE_MOST = 1e6; // as of the keys times and rates
    OptionReals *times = &flow->table.times;
    line = trim(line);
    if (line[0] == '\0' || line[0] == '#') return OK;
    char *comma = strchr(line, ',');
    if (!comma)
        return status_fail(BAD_DATA, "%s:%zu: error: a line is TIME, RATE; there is no comma", path,
                           number);
    *comma = '\0';
    TRY(read_number(trim(line), path, number, 0, TIME_MOST, times));
    TRY(read_number(trim(comma + 1), path, number, -RATE_MOST, RATE_MOST, &flow->table.rates));
    const double *last = times->values + times->count - 1;
    if (times->count == 1 || last[0] > last[-1]) return OK;
    return status_fail(BAD_DATA, "%s:%zu: error: times must ascend, but %g follows %g", path,
                       number, last[0], last[-1]);
}

static Status read_lines(char *text, const char *path, Flow *flow) {
    size_t number = 1;
    for (char *line = text; line; number++) {
        char *end = strchr(line, '\n');
        if (end) *end = '\0';
        TRY(read_line(line, path, number, flow));
        line = end ? end + 1 : NULL;
    }
    if (flow->table.times.count > 0) return OK;
    return status_fail(BAD_DATA, "%s:%zu: error: there are no times", path, number - 1);
}

Status rate_table_read(Flow *flow, const Node *node) {
    char path[PATH_SIZE], *text = NULL;
    size_t length = 0;
    if (flow->table.times.count > 0 || flow->table.rates.count > 0)
        return tree_fail(node, "shear_table has a file and numbers; give one of the two");
    TRY(find_path(path, node, flow->table.file));
    if (tree_read_file(path, &text, &length) != OK)
        return tree_fail(node, "shear_table.file: cannot read %s", path);
    const Status status = read_lines(text, path, flow);
    memory_free(text);
    flow->table.file[0] = '\0';
    return status;
}
