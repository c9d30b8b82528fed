// SPDX-License-Identifier: GPL-3.0-or-later
// `perrin show`: chooses the entries and the form.
#include "report/show.h"

#include "report/report.h"

void show_indices(const ResultSeries *series, size_t element, size_t index[RESULT_AXES]) {
    for (size_t axis = series->axes; axis-- > 0;) {
        index[axis] = element % series->axis[axis].count;
        element /= series->axis[axis].count;
    }
}

Status report_show(Text *text, const Results *results, ShowFormat format, const char *quantity) {
    Selection selection;
    TRY(select_quantity(&selection, results, quantity));
    switch (format) {
    case SHOW_TABLE:
        show_table(text, results, &selection);
        break;
    case SHOW_CSV:
        show_csv(text, results, &selection);
        break;
    case SHOW_JSON:
        show_json(text, results, &selection);
        break;
    }
    return text_status(text);
}
