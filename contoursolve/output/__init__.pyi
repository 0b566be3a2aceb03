from .baseline import (
    Baseline as Baseline,
    read_baseline as read_baseline,
)
from .catalogue import (
    alarm_rows as alarm_rows,
    catalogue_data as catalogue_data,
    catalogue_lines as catalogue_lines,
    rule_page as rule_page,
    rule_view as rule_view,
    vocabulary_lines as vocabulary_lines,
    word_set_lines as word_set_lines,
)
from .construction import (
    construction_lines as construction_lines,
)
from .contours import (
    check_table as check_table,
    count_text as count_text,
    path_of as path_of,
    path_table as path_table,
    solution_rows as solution_rows,
)
from .derivation import derivation_lines as derivation_lines
from .derivation_html import derivation_element as derivation_element
from .document import (
    Findings as Findings,
    Shelf as Shelf,
    stream_json as stream_json,
    to_json as to_json,
)
from .dxf import (
    drawing_for_cad as drawing_for_cad,
    to_dxf as to_dxf,
)
from .equations import (
    equations_of as equations_of,
    system_view as system_view,
)
from .equations_exchange import (
    systems_to_json as systems_to_json,
    to_smt as to_smt,
)
from .equations_html import (
    system_latex as system_latex,
)
from .exchange import (
    to_github as to_github,
    to_sarif as to_sarif,
)
from .explanation_html import (
    calculation_of_contour as calculation_of_contour,
    equations_of_contour as equations_of_contour,
)
from .families import (
    found_data as found_data,
    found_view as found_view,
    range_data as range_data,
    range_view as range_view,
    region_data as region_data,
    region_view as region_view,
    rest_lines as rest_lines,
    tolerances_data as tolerances_data,
    tolerances_view as tolerances_view,
    tools_data as tools_data,
    tools_lines as tools_lines,
    word_tolerance_data as word_tolerance_data,
    word_tolerance_view as word_tolerance_view,
)
from .findings import (
    EXPLAINING as EXPLAINING,
    Style as Style,
    effect_of as effect_of,
    finding_lines as finding_lines,
    finding_pieces as finding_pieces,
    plain as plain,
)
from .html import (
    bounded as bounded,
    checks_table as checks_table,
    figure as figure,
    finding_element as finding_element,
    html_text as html_text,
    notebook_style as notebook_style,
    path_element as path_element,
    remarks as remarks,
    short as short,
    solutions_table as solutions_table,
    table as table,
    table_of as table_of,
    view_element as view_element,
    words_table as words_table,
    worst_of as worst_of,
)
from .listing import (
    MOST_ALIKE as MOST_ALIKE,
    Collected as Collected,
    Totals as Totals,
    beside_of as beside_of,
    closing_lines as closing_lines,
    lines_of_findings as lines_of_findings,
    listed as listed,
    listing_lines as listing_lines,
    short_findings as short_findings,
    sources_of as sources_of,
    stream_findings as stream_findings,
    stream_listing as stream_listing,
    summary_line as summary_line,
    table_lines as table_lines,
    tool_lines as tool_lines,
    without_repeated as without_repeated,
)
from .map_frames import (
    LiveMap as LiveMap,
    map_path as map_path,
)
from .map_page import (
    map_element as map_element,
    map_page as map_page,
    map_script as map_script,
    map_style as map_style,
)
from .moved_program import (
    rewrite_beside_tool as rewrite_beside_tool,
)
from .plain_text import (
    Excerpt as Excerpt,
    Folded as Folded,
    RecordView as RecordView,
    Table as Table,
    columns as columns,
    harmless as harmless,
    printable as printable,
)
from .premises import (
    premise_data as premise_data,
)
from .receipts import (
    receipt_json as receipt_json,
    receipt_lines as receipt_lines,
    receipt_summary as receipt_summary,
)
from .report import (
    report_page as report_page,
)
from .tool_picture import (
    tool_text as tool_text,
)
from .word_meanings import (
    found_value as found_value,
    stated_value as stated_value,
    stated_words as stated_words,
)
