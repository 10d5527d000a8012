// What pipelines/report.jq says, as a page: a verdict, warnings first, checks, times.

const verdictWords = {
  good: 'Good: nothing speaks against this map. Whether it is the right one, the pattern shows.',
  usable: 'Usable: some numbers are worse than usual; look at the layers Area, Angles and Flips.',
  'look here': 'Look here before you use this map: ',
};

function add(parent, tag, text = '', className = '') {
  const child = Object.assign(document.createElement(tag), { textContent: text, className });
  parent.append(child);
  return child;
}

function addTable(parent, rows) {
  const table = add(parent, 'table');
  for (const cells of rows) {
    const row = add(table, 'tr');
    for (const cell of cells) add(row, 'td', cell);
  }
}

export function drawReport(element, report) {
  element.replaceChildren();
  add(element, 'h2', 'Report');
  if (!report) return;
  add(element, 'p', verdictWords[report.verdict] + report.look.join('; '), 'verdict');
  for (const warning of report.warnings) add(element, 'p', `Warning: ${warning}`, 'warning');
  for (const note of report.notes) add(element, 'p', `Note: ${note}`);
  addTable(element, report.checks.map(({ what, value, grade }) => [what, value, grade]));
  add(element, 'h2', 'What was done');
  if (report.command) add(element, 'code', report.command);
  add(element, 'p', `varimap ${report.version}`);
  add(element, 'h2', 'Time and memory of the stages');
  addTable(element, report.times.map(({ stage, seconds, megabytes }) =>
    [stage, `${seconds.toFixed(1)} s`, `${Math.round(megabytes)} MB`]));
}
