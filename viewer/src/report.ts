import type { ReportJson } from './data/format';
import { showReport } from './page/report_page';

const data = document.getElementById('report-data')!.textContent!;
showReport(JSON.parse(data) as ReportJson, document.getElementById('report')!);
