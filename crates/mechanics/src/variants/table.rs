//! A table of variants as a course gives it: CSV with commas, semicolons or tabs, remarks behind #, quotes around cells that hold a separator.

use super::misfit::Misfit;
use crate::model::Model;
use words::nearest;

/// A table of variants.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Name and unit of each column.
    pub header: Vec<(String, Option<String>)>,
    /// Rows, as many cells as columns.
    pub rows: Vec<Vec<String>>,
    /// Line of each row, from 1.
    pub lines: Vec<usize>,
    /// Column of the names of variants.
    pub key: usize,
}

impl Table {
    /// Reads a text; `key` is the column that names the variants, the first without it.
    ///
    /// # Errors
    /// It is empty, a line has too many or too few cells, the column of names is missing.
    pub fn parse(text: &str, key: Option<&str>) -> Result<Table, Misfit> {
        let text = text.trim_start_matches('\u{feff}');
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
        let Some((_, first)) = lines.next() else {
            return Err(Misfit::new("the table of variants is empty", "таблица вариантов пуста"));
        };
        let separator = [';', '\t'].into_iter().find(|c| first.contains(*c)).unwrap_or(',');
        let header = cells(first, separator).iter().map(|cell| name_and_unit(cell)).collect();
        let mut table = Table { header, ..Table::default() };
        for (number, line) in lines {
            let row = cells(line, separator);
            if row.len() != table.header.len() {
                return Err(uneven(number + 1, (row.len(), table.header.len())));
            }
            table.rows.push(row);
            table.lines.push(number + 1);
        }
        if let Some(key) = key {
            table.key = table.column(key)?;
        }
        Ok(table)
    }

    /// The column of that name.
    ///
    /// # Errors
    /// There is none.
    pub fn column(&self, name: &str) -> Result<usize, Misfit> {
        let columns = || self.header.iter().map(|h| h.0.as_str()).collect::<Vec<_>>().join(", ");
        let missing = || {
            Misfit::new(
                format!("there is no column `{name}`; there are {}", columns()),
                format!("нет столбца `{name}`; есть {}", columns()),
            )
        };
        self.header.iter().position(|(column, _)| column == name).ok_or_else(missing)
    }

    /// The names of the variants, in the order of the rows.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|row| row[self.key].as_str())
    }

    /// The row of a variant; none where there is none of that name.
    ///
    /// # Errors
    /// Two rows have the name: their order would decide.
    pub fn only_row(&self, name: &str) -> Result<Option<usize>, Misfit> {
        let mut found = (0..self.rows.len()).filter(|i| same(&self.rows[*i][self.key], name));
        match (found.next(), found.next()) {
            (first, None) => Ok(first),
            (first, Some(second)) => {
                let (a, b) = (first.map_or(0, |i| self.lines[i]), self.lines[second]);
                Err(Misfit::new(
                    format!("lines {a} and {b} are both variant `{name}`"),
                    format!("строки {a} и {b} задают один вариант `{name}`"),
                ))
            }
        }
    }

    /// The columns whose values are taken.
    ///
    /// # Errors
    /// A column is missing, is no name of the model, or stands there twice.
    pub fn used(&self, model: &Model) -> Result<Vec<usize>, Misfit> {
        let variants = model.variants.as_ref();
        let listed = variants.and_then(|v| v.columns.as_ref());
        let helpers = || variants.into_iter().flat_map(|v| &v.helpers).map(|h| &h.name);
        let used: Vec<usize> = match listed {
            Some(columns) => columns.iter().map(|name| self.column(name)).collect::<Result<_, _>>()?,
            None => self.known(model)?,
        };
        let all = used.iter().copied().chain(helpers().map(|name| self.column(name)).collect::<Result<Vec<_>, _>>()?);
        all.chain([self.key]).try_for_each(|i| self.once(i))?;
        Ok(used)
    }

    fn known(&self, model: &Model) -> Result<Vec<usize>, Misfit> {
        let known = |name: &str| {
            let base = name.strip_suffix('\'').unwrap_or(name);
            model.parameters.iter().any(|p| p.name == name) || model.coordinates.iter().any(|c| c.name == base)
        };
        let others = (0..self.header.len()).filter(|i| *i != self.key);
        let (used, foreign): (Vec<usize>, Vec<usize>) = others.partition(|i| known(&self.header[*i].0));
        foreign.first().map_or(Ok(used), |i| Err(foreign_column(&self.header[*i].0, model)))
    }

    /// Two columns of one quantity contradict each other.
    fn once(&self, i: usize) -> Result<(), Misfit> {
        let name = &self.header[i].0;
        let mut twins = (0..self.header.len()).filter(|j| self.header[*j].0 == *name);
        if let (Some(a), Some(b)) = (twins.next(), twins.next()) {
            let (a, b) = (a + 1, b + 1);
            return Err(Misfit::new(
                format!("columns {a} and {b} are both `{name}`"),
                format!("столбцы {a} и {b} называются одинаково: `{name}`"),
            ));
        }
        Ok(())
    }
}

/// `3`, `03` and `3.0` are one variant.
fn same(cell: &str, name: &str) -> bool {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    cell == name.trim() || number(cell).is_some_and(|n| number(name) == Some(n))
}

/// The cells of a line; quotes protect separators, two quotes inside quotes are one.
pub fn cells(line: &str, separator: char) -> Vec<String> {
    let mut found = vec![String::new()];
    let mut quoted = false;
    let mut letters = line.trim_end_matches('\r').chars().peekable();
    while let Some(c) = letters.next() {
        match c {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                found.iter_mut().last().into_iter().for_each(|cell| cell.push('"'));
            }
            '"' => quoted = !quoted,
            c if c == separator && !quoted => found.push(String::new()),
            c => found.iter_mut().last().into_iter().for_each(|cell| cell.push(c)),
        }
    }
    found.iter().map(|cell| cell.trim().to_owned()).collect()
}

/// `m [g]` is m in g.
fn name_and_unit(cell: &str) -> (String, Option<String>) {
    match cell.strip_suffix(']').and_then(|c| c.split_once('[')) {
        Some((name, unit)) => (name.trim().to_owned(), Some(unit.trim().to_owned())),
        None => (cell.to_owned(), None),
    }
}

fn uneven(line: usize, (cells, columns): (usize, usize)) -> Misfit {
    Misfit::new(
        format!("line {line} has {cells} cells, the header has {columns}"),
        format!("в строке {line} клеток {cells}, а столбцов {columns}"),
    )
    .help(
        "give each line one cell a column; a cell that holds a separator stands in quotes",
        "задайте в каждой строке по клетке на столбец; клетку с разделителем внутри берут в кавычки",
    )
}

fn foreign_column(name: &str, model: &Model) -> Misfit {
    let names = model.parameters.iter().map(|p| p.name.as_str()).chain(model.coordinates.iter().map(|c| c.name.as_str()));
    let near = nearest(name, names);
    let fault = Misfit::new(
        format!("the column `{name}` is no parameter or coordinate"),
        format!("столбец `{name}` — не параметр и не координата"),
    );
    match near {
        Some(near) => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => fault.help(
            "name the columns that count: columns = [\"m\", \"c\"] under [variants]",
            "перечислите нужные столбцы: columns = [\"m\", \"c\"] в [variants]",
        ),
    }
}
