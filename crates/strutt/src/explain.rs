//! Explanations of every code that a message can carry, gathered from all rooms.

use words::explain::{Explanation, plain};
use words::nearest;

/// The tables of all rooms, from below.
fn tables() -> impl Iterator<Item = &'static [Explanation]> {
    let rooms = [mechanics::explain::TABLES, &[program::EXPLANATIONS], analysis::explain::TABLES, &[studies::variants::EXPLANATIONS, OWN]];
    let of_studies = studies::TABLE.iter().map(|study| study.explanations());
    rooms.into_iter().flatten().copied().chain(of_studies)
}

/// Every code, in the order of the rooms.
pub fn all() -> impl Iterator<Item = &'static Explanation> {
    tables().flatten()
}

/// The explanation of a code; small letters do too.
pub fn find(code: &str) -> Option<&'static Explanation> {
    all().find(|e| e.code.eq_ignore_ascii_case(code))
}

/// A code that may have been meant.
pub fn near(code: &str) -> Option<&'static str> {
    nearest(code, all().map(|e| e.code))
}

/// What the command line itself can say.
const OWN: &[Explanation] = &[
    plain(
        "S104",
        ("Statics without the machine", "Статика без механизма"),
        (
            "A frame carries bodies, springs or other elements of a machine. `statics` adds what these exert at rest along the named displacements, \
             found from the equilibrium of both. That needs loads that stand still, independent displacements and a flexibility matrix (at most \
             12 displacements, 400 freedoms). Otherwise the structure alone would be computed as if nothing stood on it, so it is refused.",
            "Рама несёт тела, пружины или другие элементы механизма. `statics` добавляет их действие в покое вдоль именованных перемещений, \
             найденное из общего равновесия. Для этого нужны постоянные нагрузки, независимые перемещения и матрица податливости (не более 12 \
             перемещений и 400 степеней свободы). Иначе конструкция считалась бы пустой, поэтому расчёт не выполняется.",
        ),
    ),
    plain(
        "S101",
        ("Inverse dynamics without a motor", "Обратная задача без двигателя"),
        (
            "`inverse` finds the forces and torques of [motors] that realise the prescribed [motions]. A model without motors has none; its motion \
             under given forces is found by `simulate`, its reactions at rest by `statics`.",
            "`inverse` находит усилия и моменты двигателей [motors], осуществляющих заданные движения [motions]. В модели без двигателей искать \
             нечего; движение под заданными силами находит `simulate`, реакции в покое – `statics`.",
        ),
    ),
    plain(
        "S105",
        ("Not for structures", "Не для конструкций"),
        (
            "`over`, `guess` and `about` belong to the modes of machines. A frame or truss without bodies is linear and is computed for the data \
             of the file; other values come with --set.",
            "`over`, `guess` и `about` относятся к формам механизмов. Рама или ферма без тел линейна и считается по данным файла; другие \
             значения задают ключом --set.",
        ),
    ),
    plain(
        "C001",
        ("No such file", "Нет такого файла"),
        (
            "The model file was not found. Give the path of a .toml file, a folder that holds a model.toml, or - for standard input. `strutt examples` \
             lists ready models; `strutt new NAME` writes one to start from.",
            "Файл модели не найден. Укажите путь к файлу .toml, папку, в которой лежит model.toml, или - для стандартного ввода. `strutt examples` \
             показывает готовые модели; `strutt new ИМЯ` записывает модель, с которой можно начать.",
        ),
    ),
    plain(
        "C002",
        ("Unreadable file", "Файл не читается"),
        (
            "The file exists but the system does not let it be read: no permission, a broken disk, a device.",
            "Файл есть, но система не даёт его прочитать: нет прав доступа, неисправен диск, это устройство.",
        ),
    ),
    plain(
        "C003",
        ("File too large", "Слишком большой файл"),
        (
            "A model file is text of at most 4 MiB. Something much larger is probably data or a picture.",
            "Файл модели – это текст не более 4 МиБ. Если он гораздо больше, вероятно, это данные или рисунок.",
        ),
    ),
    plain(
        "C004",
        ("Not UTF-8", "Кодировка не UTF-8"),
        (
            "A model file is text in UTF-8, with or without a byte order mark. Old Windows editors save Russian text in Windows-1251: choose UTF-8 \
             when saving.",
            "Файл модели – это текст в UTF-8, с меткой порядка байтов или без неё. Старые редакторы Windows сохраняют русский текст в Windows-1251: \
             при сохранении выберите UTF-8.",
        ),
    ),
    plain(
        "C005",
        ("Cannot write", "Не удаётся записать"),
        (
            "A result could not be written: the disk is full, the folder is write-protected, or a file stands where a folder is needed. The files \
             of a calculation take their places together or not at all; earlier results are untouched then.",
            "Результат не записан: диск заполнен, папка защищена от записи или на месте папки стоит файл. Файлы расчёта занимают свои места все \
             вместе или никак; прежние результаты тогда не испорчены.",
        ),
    ),
    plain(
        "C052",
        ("A result would replace an input", "Результат заменил бы исходный файл"),
        (
            "A file of results would get the name of the model file or of its table of variants, in the same folder. Nothing is written: what a \
             calculation was made from stays. Choose another folder with --out, or rename the input.",
            "Файл результатов получил бы имя файла модели или её таблицы вариантов в той же папке. Ничего не записывается: исходные данные \
             остаются. Укажите другую папку ключом --out или переименуйте исходный файл.",
        ),
    ),
    plain(
        "C061",
        ("No PDF of this format", "Из этого формата PDF не делается"),
        (
            "`strutt report --pdf` prints HTML by a browser and compiles Typst and LaTeX by their own programs; Markdown and text have no pages.",
            "`strutt report --pdf` печатает HTML браузером, а Typst и LaTeX собирает их программами; у Markdown и текста страниц нет.",
        ),
    ),
    plain(
        "C062",
        ("No program for PDF", "Нет программы для PDF"),
        (
            "strutt makes no PDF by itself: it asks chromium, chrome or edge to print, or typst, xelatex, lualatex, pdflatex to compile, whichever stands on the \
             path. Without them open the page in any browser and print it to a file.",
            "Сама strutt PDF не делает: она просит chromium, chrome или edge напечатать страницу либо typst, xelatex, lualatex, pdflatex собрать её – что найдётся в \
             PATH. Если их нет, откройте страницу в любом браузере и напечатайте её в файл.",
        ),
    ),
    plain(
        "C063",
        ("The program made no PDF", "Программа не сделала PDF"),
        (
            "A browser or a compiler that `--pdf` called ended without a file; its own words stand behind the message. The page itself is written.",
            "Браузер или компилятор, который вызвал ключ `--pdf`, завершился без файла; его слова приведены в сообщении. Сама страница записана.",
        ),
    ),
    plain(
        "C080",
        ("ffmpeg made no film", "ffmpeg не сделал фильм"),
        (
            "`--animate` writes moving pictures as SVG, which every browser plays, and asks ffmpeg, where it is installed, for an MP4. It ended without one; its own \
             words stand behind the message. The SVG is written.",
            "Ключ `--animate` записывает движущиеся картинки как SVG – его проигрывает любой браузер – и просит ffmpeg, если он установлен, сделать MP4. Программа \
             завершилась без файла; её слова приведены в сообщении. SVG записан.",
        ),
    ),
    plain(
        "C074",
        ("Rows of an unfinished run", "Строки незаконченного запуска"),
        (
            "A sweep with --out keeps each row in sweep.rows of that folder as soon as it is done, and takes the file away when all tables are written. A run that was killed leaves it: --resume \
             goes on there and gives the same bytes as a run that was not killed. Without --resume nothing is overwritten.",
            "Серия с ключом --out сохраняет каждую готовую строку в файле sweep.rows этой папки и удаляет его, когда записаны все таблицы. После снятия программы он остаётся: --resume \
             продолжает с него и даёт те же байты, что и непрерванный запуск. Без --resume ничего не перезаписывается.",
        ),
    ),
    plain(
        "C075",
        ("Two runs into one folder", "Два запуска в одну папку"),
        (
            "Another run of a sweep is writing its rows into this folder. Two would mix them. Wait for the other, or give each a folder of its own.",
            "Другой запуск серии пишет свои строки в эту папку. Вместе они бы их перемешали. Дождитесь его или задайте каждому свою папку.",
        ),
    ),
    plain(
        "C076",
        ("No rows of a part", "Нет строк части"),
        (
            "`strutt merge` reads the file sweep.rows of each folder, which `strutt sweep --shard I/N --out DIR` leaves there.",
            "Команда `strutt merge` читает из каждой папки файл sweep.rows, который оставляет `strutt sweep --shard I/N --out ПАПКА`.",
        ),
    ),
    plain(
        "C077",
        ("No values from a column", "Нет значений из столбца"),
        (
            "--over 'm=column(\"masses.csv\",\"m\")' takes the values of a sweep from a table: its first line has the heads, `m` or `m [kg]`, and every other line a number there. Cells are parted by commas, or by semicolons with decimal commas. The file is looked for \
             from the folder in which strutt is started.",
            "Ключ --over 'm=column(\"masses.csv\",\"m\")' берёт значения серии из таблицы: в первой её строке заголовки, `m` или `m [kg]`, в остальных под ними числа. Ячейки разделены запятыми либо точками с запятой при десятичной запятой. Файл ищется от папки, в \
             которой запущен strutt.",
        ),
    ),
    plain(
        "C073",
        ("A format without pages", "Формат без страниц"),
        (
            "`strutt report` writes a document with formulas and figures: html, markdown, latex, typst, docx. Text for the terminal, CSV and JSON hold none; the numbers \
             of a calculation come from `strutt run FILE --json` or from a study with `--csv`.",
            "`strutt report` составляет документ с формулами и рисунками: html, markdown, latex, typst, docx. В тексте для терминала, CSV и JSON их нет; числа расчёта \
             дают `strutt run ФАЙЛ --json` и расчёты с ключом `--csv`.",
        ),
    ),
    plain(
        "C053",
        ("Not a name for a file", "Негодное имя файла"),
        (
            "`strutt new` writes NAME.toml. The name is a path whose last part is not empty and is not `.` or `..`.",
            "`strutt new` записывает файл ИМЯ.toml. Имя – это путь, последняя часть которого не пуста и не равна `.` или `..`.",
        ),
    ),
    plain(
        "C006",
        ("File exists", "Файл уже есть"),
        ("`strutt new` never overwrites a file.", "`strutt new` никогда не перезаписывает файл."),
    ),
    plain(
        "C040",
        ("No such section", "Нет такого сечения"),
        (
            "`section` shows the tables [sections.NAME] of a file; the file has none, or none of the name given by --name.",
            "Команда `section` показывает таблицы [sections.ИМЯ] файла; в файле их нет или нет сечения с именем из --name.",
        ),
    ),
    plain(
        "C007",
        ("No end of the motion", "Не задан конец движения"),
        (
            "`simulate` needs an end: --until on the command line, times in --at, or a study `simulate` in the file.",
            "Команде `simulate` нужен конец движения: ключ --until, моменты в --at или расчёт `simulate` в файле.",
        ),
    ),
    plain(
        "C008",
        ("No such output", "Нет такой выходной величины"),
        (
            "--outputs takes names of coordinates (phi), rates (phi'), accelerations (phi''), auxiliary states and the outputs of the file, with commas \
             between. In a shell, put a name with a prime into double quotes.",
            "Ключ --outputs принимает имена координат (phi), скоростей (phi'), ускорений (phi''), вспомогательных состояний и выходных величин файла через \
             запятую. В командной оболочке имя со штрихом заключают в двойные кавычки.",
        ),
    ),
    plain(
        "C009",
        ("Bad value on the command line", "Негодное значение в командной строке"),
        (
            "Quantities on the command line are numbers with or without a unit: 30, 30s, \"1,5 min\". A number without unit is in SI.",
            "Величины в командной строке – это числа с единицей или без неё: 30, 30с, \"1,5 мин\". Число без единицы понимается в СИ.",
        ),
    ),
    plain(
        "C054",
        ("An option that changes nothing", "Ключ, который ничего не меняет"),
        (
            "The option needs something that neither the command line nor the study of the file gives: --turns a section that is an angle, --flywheel \
             a wanted irregularity. Passed over in silence it would look as if it had been taken.",
            "Ключу нужно то, чего нет ни в командной строке, ни в расчёте файла: --turns – сечение-угол, --flywheel – заданная неравномерность \
             хода. Если бы его молча пропускали, казалось бы, что он учтён.",
        ),
    ),
    plain(
        "C055",
        ("No such body", "Нет такого тела"),
        (
            "strutt scheme FILE --body NAME draws a body alone: NAME is one of [bodies].",
            "strutt scheme FILE --body NAME изображает одно тело; NAME – одно из [bodies].",
        ),
    ),
    plain(
        "C056",
        ("Nothing to draw", "Нечего чертить"),
        (
            "A scheme shows bodies, their connections and loads, frames and trusses. The file has none of them; sections have drawings of their own: strutt section FILE --out DIR.",
            "Схема изображает тела, их связи и нагрузки, рамы и фермы. В файле ничего из этого нет; у сечений свои чертежи: strutt section FILE --out DIR.",
        ),
    ),
    plain(
        "C057",
        ("A place that the motion does not reach", "Положение, которого движение не достигает"),
        (
            "strutt scheme FILE --at TIME draws the machine at a time of its motion. The motion ends before that time, at an event or because it cannot go on.",
            "strutt scheme FILE --at TIME изображает машину в момент движения. Движение кончается раньше: событием или потому, что не может продолжаться.",
        ),
    ),
    plain(
        "C010",
        ("No such name", "Нет такого имени"),
        (
            "`strutt examples` lists the examples; codes stand in brackets in each message.",
            "`strutt examples` показывает примеры; коды стоят в скобках в каждом сообщении.",
        ),
    ),
    plain(
        "C050",
        ("No published results", "Нет опубликованных результатов"),
        (
            "`strutt claims` lays the tables [[claims]] of a file against the machine; the file has none.",
            "Команда `strutt claims` сопоставляет с машиной таблицы [[claims]] файла; в файле их нет.",
        ),
    ),
    plain(
        "C051",
        ("A claim that cannot be compared", "Результат не с чем сопоставить"),
        (
            "The formula of a claim has no meaning for this machine: it asks for something that the derivation does not give.",
            "Формула результата не имеет смысла для этой машины: она требует того, чего вывод не даёт.",
        ),
    ),
    plain(
        "C031",
        ("Not a parameter with a number", "Не параметр с числом"),
        (
            "An unknown that a study looks for must be a parameter of the model whose value is a number.",
            "Неизвестная, которую ищет расчёт, – параметр модели с числовым значением.",
        ),
    ),
    plain(
        "C032",
        ("No study to repeat", "Нет расчёта для серии"),
        (
            "A sweep repeats a study of the file; the message names the kinds that can be repeated. Add one of them, or observe `period`.",
            "Серия повторяет расчёт из файла; виды, которые можно повторять, названы в сообщении. Добавьте один из них или наблюдайте `period`.",
        ),
    ),
    plain(
        "C033",
        ("Over which values?", "По каким значениям?"),
        (
            "A sweep needs --over \"v=linspace(1 m/s, 3 m/s, 21)\" or a study `sweep` in the file.",
            "Серии нужен ключ --over \"v=linspace(1 м/с, 3 м/с, 21)\" или расчёт `sweep` в файле.",
        ),
    ),
    plain(
        "C034",
        ("Which angle?", "Какой угол?"),
        (
            "The cycle needs --angle phi1 or a study `cycle` in the file.",
            "Расчёту цикла нужен ключ --angle phi1 или расчёт `cycle` в файле.",
        ),
    ),
    plain(
        "C035",
        ("Which coordinate is driven?", "Какая координата ведущая?"),
        (
            "Kinematics needs --over phi1 or a study `kinematics` in the file.",
            "Кинематике нужен ключ --over phi1 или расчёт `kinematics` в файле.",
        ),
    ),
    plain(
        "C036",
        ("No positions", "Нет положений"),
        (
            "A range of positions needs two different ends (or turns other than zero), a rate other than zero and at least two positions.",
            "Промежутку положений нужны разные концы (или ненулевое число оборотов), ненулевая скорость и не менее двух положений.",
        ),
    ),
    plain(
        "C020",
        ("No variants", "Нет вариантов"),
        (
            "--variant takes a row of a table that the model file names: [variants] with table = \"variants.csv\", or the rows themselves.",
            "Ключ --variant берёт строку таблицы, которую называет файл модели: [variants] и table = \"variants.csv\" или сами строки в rows.",
        ),
    ),
    plain(
        "C021",
        ("No such variant", "Нет такого варианта"),
        (
            "The name after --variant stands in the first column of the table, or in the column named by `key`.",
            "Имя после --variant стоит в первом столбце таблицы или в столбце, указанном в `key`.",
        ),
    ),
    plain(
        "C022",
        ("A table of variants that does not fit", "Таблица вариантов не подходит"),
        (
            "The first line of the table names parameters, coordinates (starts) and phi' (rates) of the model, with a unit in brackets where numbers are not SI; each further line has as many cells. `columns` under [variants] picks the columns that count. \
             Neither a variant nor a column that counts may stand in the table twice: which of the two holds would depend on their order.",
            "Первая строка таблицы называет параметры, координаты (начальные значения) и phi' (скорости) модели, с единицей в скобках, если числа не в СИ; в остальных строках столько же клеток. Ключ `columns` в [variants] выбирает нужные столбцы. \
             Ни вариант, ни нужный столбец не может стоять в таблице дважды: какой из двух верен, решал бы их порядок.",
        ),
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_unique_and_explained_in_both_languages() {
        let all: Vec<_> = all().collect();
        for (i, e) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|f| f.code != e.code), "{} twice", e.code);
            for words in [e.title.0, e.title.1, e.text.0, e.text.1] {
                assert!(!words.trim().is_empty(), "{}", e.code);
            }
        }
    }

    #[test]
    fn small_letters_and_slips_are_understood() {
        assert_eq!(find("c001").map(|e| e.code), Some("C001"));
        assert!(near("C0O1").is_some());
    }
}
