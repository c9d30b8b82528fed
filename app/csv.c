// SPDX-License-Identifier: GPL-3.0-or-later
// Small tables of words.
#include "csv.h"

#include "base/memory.h"
#include "base/number.h"

#include <stdio.h>
#include <string.h>

enum { TEXT_MOST = 1 << 20 };

Status csv_read_text(const char *path, char **out) {
    FILE *file = fopen(path, "r");
    if (!file) return status_fail_errno(IO_FAILED, "cannot read %s", path);
    char *text = NULL;
    Status status = NEW_ARRAY(text, TEXT_MOST + 1);
    const size_t length = text ? fread(text, 1, TEXT_MOST + 1, file) : 0;
    if (status == OK && ferror(file)) status = status_fail(IO_FAILED, "cannot read %s", path);
    if (status == OK && length > TEXT_MOST) {
        status = status_fail(BAD_DATA, "%s is longer than %d bytes", path, TEXT_MOST);
    }
    fclose(file);
    if (status != OK) {
        memory_free(text);
        return status;
    }
    text[length] = '\0';
    *out = text;
    return OK;
}

// Ends the cell that begins at `*at` with '\0', moves behind it and its comma.
static char *next_cell(char **at) {
    char *cell = *at, *end;
    if (*cell == '"') {
        cell++;
        end = strchr(cell, '"');
        if (!end) end = cell + strlen(cell);
        if (*end) *end++ = '\0';
    } else
        end = cell + strcspn(cell, ",");
    const char separator = *end;
    if (*end) *end++ = '\0';
    *at = separator ? end : NULL;
    return cell;
}

static size_t split_line(char *line, char **cells, size_t most) {
    size_t count = 0;
    for (char *at = line; at && count < most;) cells[count++] = next_cell(&at);
    return count;
}

// The next line that is neither blank nor a comment; NULL at the end.
static char *next_line(char **at) {
    while (**at) {
        char *line = *at;
        const size_t length = strcspn(line, "\n");
        *at = line + length + (line[length] != '\0');
        line[length] = '\0';
        if (length && line[0] != '#') return line;
    }
    return NULL;
}

static size_t count_of(const char *text, char wanted) {
    size_t count = 1;
    for (; *text; text++) count += *text == wanted;
    return count;
}

static Status split(Csv *csv) {
    char *at = csv->text, *line;
    const size_t lines = count_of(csv->text, '\n');
    char *header = next_line(&at);
    if (!header) return status_fail(BAD_DATA, "%s has no header", csv->path);
    csv->columns = count_of(header, ',');
    TRY(NEW_ARRAY(csv->header, csv->columns));
    TRY(NEW_ARRAY(csv->cells, lines * csv->columns));
    csv->columns = split_line(header, csv->header, csv->columns);
    while ((line = next_line(&at))) {
        char **cells = csv->cells + csv->rows++ * csv->columns;
        for (size_t c = split_line(line, cells, csv->columns); c < csv->columns; c++) cells[c] = "";
    }
    return OK;
}

Status csv_read(Csv **out, const char *path) {
    Csv *csv = NULL;
    TRY(NEW(csv));
    snprintf(csv->path, sizeof csv->path, "%s", path);
    Status status = csv_read_text(path, &csv->text);
    if (status == OK) status = split(csv);
    if (status != OK) {
        csv_free(csv);
        return status;
    }
    *out = csv;
    return OK;
}

void csv_free(Csv *csv) {
    if (!csv) return;
    memory_free(csv->text);
    memory_free(csv->header);
    memory_free(csv->cells);
    memory_free(csv);
}

const char *csv_cell(const Csv *csv, size_t row, const char *column) {
    for (size_t c = 0; c < csv->columns; c++) {
        if (strcmp(csv->header[c], column) == 0) return csv->cells[row * csv->columns + c];
    }
    return "";
}

Status csv_number(const Csv *csv, size_t row, const char *column, double fallback, double *value) {
    const char *cell = csv_cell(csv, row, column);
    *value = fallback;
    if (*cell == '\0' || number_read(cell, value)) return OK;
    return status_fail(BAD_DATA, "%s, row %zu: %s = '%s' is not a number", csv->path, row + 1,
                       column, cell);
}
